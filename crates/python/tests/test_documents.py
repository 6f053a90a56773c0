"""What the README, the book and the API page show is true."""

from __future__ import annotations

import pathlib
import re
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT

BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", ["README.md", "docs/src/python.md"])
def test_the_python_of_a_page_runs(
    page: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(ROOT / "scenes", tmp_path / "scenes")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    blocks = BLOCK.findall((ROOT / page).read_text(encoding="utf-8"))
    assert blocks
    for number, block in enumerate(blocks):
        exec(compile(block, f"{page}, block {number + 1}", "exec"), names)


def test_the_example_certifies_a_sheet_and_films_it(tmp_path: pathlib.Path) -> None:
    example = ROOT / "crates/python/examples/shelter.py"
    scene = ROOT / "scenes/one-unit.toml"
    ran = subprocess.run(
        [sys.executable, example, scene, tmp_path / "out"], capture_output=True, text=True, check=True
    )
    assert "folded" in ran.stdout and "VERIFIED" in ran.stdout
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"report.json", "certificate.json", "motion.fold", "motion.gif", "film.mp4"} <= names


def test_the_api_page_is_made_from_the_docstrings() -> None:
    """After a change of docstrings: python crates/python/api_page.py > docs/src/python-api.md."""
    made = subprocess.run(
        [sys.executable, ROOT / "crates/python/api_page.py"], capture_output=True, text=True, check=True
    )
    assert made.stdout == (ROOT / "docs/src/python-api.md").read_text(encoding="utf-8")
