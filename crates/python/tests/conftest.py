"""Scenes and results that several tests share."""

from __future__ import annotations

import pathlib

import foldmotion
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]

SMALL = {
    "title": "small",
    "profile": {"model": "shelter"},
    "sheet": {"rows": 2, "columns": 1},
    "motion": {"contact": False, "frames": 8},
    "record": {"size": [96, 72], "fps": 2.0, "outputs": ["fold", "gif", "csv"]},
}


@pytest.fixture(scope="session")
def scenes() -> pathlib.Path:
    return ROOT / "scenes"


@pytest.fixture(scope="session")
def small() -> foldmotion.Result:
    return foldmotion.Scene.from_dict(SMALL).resolve().run()


@pytest.fixture(scope="session")
def one_unit(scenes: pathlib.Path) -> foldmotion.Result:
    return foldmotion.Scene.from_file(scenes / "one-unit.toml").resolve().run()
