"""Prints the API page of the book from the docstrings of the installed package.

    python crates/python/api_page.py > docs/src/python-api.md
"""

from __future__ import annotations

import inspect
import re

import foldmotion

HEADER = """# Python API

Made from the docstrings by `crates/python/api_page.py`. How the pieces go together is in [From Python](python.md).
"""
SECTION = re.compile(r"^([A-Z][A-Za-z ]+)\n-{3,}$", re.MULTILINE)


def prose(text: str) -> str:
    """Turn the markup of docstrings into Markdown."""
    text = re.sub(r":\w+:`([^`]+)`", r"`\1`", text)
    return text.replace("``", "`").replace("\\|", "|")


def entries(section: str) -> str:
    """Turn the entries of a section into a list, each on one line."""
    lines: list[str] = []
    for line in section.strip("\n").splitlines():
        if line.startswith("    "):
            lines[-1] += f"{' ' if ': ' in lines[-1] else ': '}{line.strip()}"
        elif line.strip():
            name, colon, kind = line.partition(" : ")
            lines.append(f"- `{name}`{f' ({kind})' if colon else ''}")
    return "\n".join(lines)


def markdown(doc: str) -> str:
    """Turn a numpydoc docstring into Markdown."""
    parts = SECTION.split(inspect.cleandoc(doc))
    out = [prose(parts[0].strip())]
    for title, content in zip(parts[1::2], parts[2::2], strict=True):
        out.append(f"*{title}*\n\n{prose(entries(content))}")
    return "\n\n".join(out)


def signature(thing: object) -> str:
    """Return the parameters as they are written, without the receiver."""
    try:
        text = str(inspect.signature(thing))  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return ""
    text = re.sub(r" -> .*$", "", text)
    return re.sub(r"\((\$?self|self, /)(, )?", "(", text).replace("(/, ", "(").replace("(/)", "()")


def members(kind: type) -> list[str]:
    """Return the documented members of a class, in the order of the alphabet."""
    out = []
    for name, member in sorted(vars(kind).items()):
        doc = inspect.getdoc(member)
        if name.startswith("_") or not doc:
            continue
        is_data = inspect.isgetsetdescriptor(member) or inspect.ismemberdescriptor(member)
        bound = getattr(kind, name)
        title = name if is_data else f"{name}{signature(bound)}"
        out.append(f"#### `{kind.__name__}.{title}`\n\n{markdown(doc)}")
    return out


def main() -> None:
    """Print the page."""
    things = [(name, getattr(foldmotion, name)) for name in foldmotion.__all__ if name != "__version__"]
    errors = [t for t in things if inspect.isclass(t[1]) and issubclass(t[1], Exception)]
    classes = [t for t in things if inspect.isclass(t[1]) and t not in errors]
    functions = [t for t in things if not inspect.isclass(t[1])]
    blocks = [HEADER.strip(), "## Functions"]
    for name, function in functions:
        blocks.append(f"### `{name}{signature(function)}`\n\n{markdown(inspect.getdoc(function) or '')}")
    blocks.append("## Classes")
    for name, kind in classes:
        blocks.append(f"### `{name}`\n\n{markdown(inspect.getdoc(kind) or '')}")
        blocks.extend(members(kind))
    blocks.append("## Exceptions")
    for name, kind in errors:
        bases = ", ".join(f"`{base.__name__}`" for base in kind.__bases__)
        blocks.append(f"### `{name}`\n\nA kind of {bases}. {markdown(inspect.getdoc(kind) or '')}")
    print("\n\n".join(blocks))


if __name__ == "__main__":
    main()
