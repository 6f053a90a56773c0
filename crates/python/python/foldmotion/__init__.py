"""foldmotion: how a sheet of origami units folds, and whether it passes through itself on the way.

>>> import foldmotion
>>> scene = foldmotion.Scene.from_dict({"profile": {"model": "shelter"}, "sheet": {"rows": 2, "columns": 1}})
>>> result = scene.resolve().run()
>>> result.outcome, result.verdict
('folded', 'touching')
>>> result.motion.positions.shape
(121, 18, 3)
"""

from foldmotion._document import Certificate, Document, Report
from foldmotion._errors import (
    BadInput,
    DidNotConverge,
    Error,
    Interrupted,
    Jammed,
    OutcomeError,
    OutputError,
    RunFailed,
    Stopped,
    Undecided,
)
from foldmotion._native import (
    Model,
    Motion,
    Pattern,
    Result,
    Scene,
    Series,
    Study,
    Verification,
    __version__,
    check,
    fold_pattern,
    models,
    read_fold,
    verify,
)

__all__ = [
    "BadInput",
    "Certificate",
    "DidNotConverge",
    "Document",
    "Error",
    "Interrupted",
    "Jammed",
    "Model",
    "Motion",
    "OutcomeError",
    "OutputError",
    "Pattern",
    "Report",
    "Result",
    "RunFailed",
    "Scene",
    "Series",
    "Stopped",
    "Study",
    "Undecided",
    "Verification",
    "__version__",
    "check",
    "fold_pattern",
    "models",
    "read_fold",
    "verify",
]
