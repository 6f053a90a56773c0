"""Reports and certificates: the JSON of foldmotion, with attributes."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any


class Document:
    """An object of JSON whose keys are attributes.

    Objects inside it are documents too, lists stay lists, and ``null`` is ``None``. It does not change.
    """

    __slots__ = ("_values",)

    _values: dict[str, Any]

    def __init__(self, values: dict[str, Any]) -> None:
        object.__setattr__(self, "_values", values)

    def __getattr__(self, name: str) -> Any:
        try:
            return _wrapped(self._values[name])
        except KeyError:
            known = ", ".join(self._values)
            raise AttributeError(f"there is no {name}; there are {known}") from None

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{type(self).__name__} does not change: {name} cannot be set")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{type(self).__name__} does not change: {name} cannot be deleted")

    def __getitem__(self, name: str) -> Any:
        return _wrapped(self._values[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __contains__(self, name: object) -> bool:
        return name in self._values

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Document) and self._values == other._values

    __hash__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._values]

    def __repr__(self) -> str:
        return f"<foldmotion.{type(self).__name__} {', '.join(self._values)}>"

    def to_dict(self) -> dict[str, Any]:
        """Return a copy as dictionaries, lists, strings, numbers, booleans and None."""
        copy: dict[str, Any] = json.loads(json.dumps(self._values))
        return copy


class _File(Document):
    """A document with the text of its file."""

    __slots__ = ("_text",)

    _text: str

    def __init__(self, text: str) -> None:
        super().__init__(json.loads(text))
        object.__setattr__(self, "_text", text)

    def to_json(self) -> str:
        """Return the text of the file, byte for byte as the command line writes it."""
        return self._text


class Report(_File):
    """Everything a run found: ``report.json``, whose fields are described in its schema (``schemas/report.json``)."""

    __slots__ = ()


class Certificate(_File):
    """What was proved of a motion, and under which assumptions: ``certificate.json``."""

    __slots__ = ()


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Document(value)
    if isinstance(value, list):
        return [_wrapped(item) for item in value]
    return value
