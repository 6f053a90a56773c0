"""The exceptions. Their text is that of the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from foldmotion._native import Result


class Error(Exception):
    """Base of all exceptions of foldmotion.

    Attributes
    ----------
    status : int
        The exit status of the command line for this error: 2 bad input, 3 anything else.
    key : str or None
        The dotted key of the scene that the error is about, if there is one.
    """

    def __init__(self, message: str, status: int = 3, key: str | None = None) -> None:
        super().__init__(message)
        self.status = status
        self.key = key


class BadInput(Error, ValueError):
    """A scene, a file, an array or an argument cannot be used. The text names it, the value and the remedy."""

    def __init__(self, message: str, status: int = 2, key: str | None = None) -> None:
        super().__init__(message, status, key)


class OutputError(Error, OSError):
    """A file cannot be written, or would replace one that foldmotion did not make."""


class RunFailed(Error, RuntimeError):
    """The engine, the check or a recording failed though the input is right."""


class Interrupted(Error):
    """A progress function returned ``False``. Earlier results are untouched."""


class OutcomeError(Error):
    """Raised by :meth:`Result.raise_for_outcome` for a motion that did not come to a decided end.

    Attributes
    ----------
    result : Result
        The result, with the motion as far as it came.
    """

    def __init__(self, message: str, status: int, result: Result) -> None:
        super().__init__(message, status)
        self.result = result


class Jammed(OutcomeError):
    """Layers in contact keep the sheet from its end."""


class Stopped(OutcomeError):
    """The engine found no further equilibrium, or its budget ended first."""


class DidNotConverge(OutcomeError):
    """The sheet was run to its end, but not into an equilibrium near the targets of its creases."""


class Undecided(OutcomeError):
    """The sheet reached its end, but whether it passes through itself was not decided."""
