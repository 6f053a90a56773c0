"""What is wrong is refused with words, never with a crash."""

from __future__ import annotations

import pathlib
import threading
from typing import Any

import foldmotion
import numpy as np
import pytest
from conftest import SMALL

VERTICES = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
EDGES = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]
LETTERS = ["B", "B", "B", "B", "V"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (([0.0, 1.0], EDGES, LETTERS), r"vertices: shape \(2,\), expected \(n, 2\)"),
        ((np.zeros((4, 3)), EDGES, LETTERS), r"vertices: shape \(4, 3\), expected \(n, 2\)"),
        ((np.zeros((4, 2), complex), EDGES, LETTERS), "vertices: dtype complex128"),
        ((np.array([["a", "b"]] * 4), EDGES, LETTERS), "vertices: dtype <U1"),
        ((np.zeros((4, 2), object), EDGES, LETTERS), "vertices: dtype object"),
        (([[0.0, 0.0], [1.0]], EDGES, LETTERS), "vertices: "),
        (([*VERTICES[:3], [np.nan, 0.0]], EDGES, LETTERS), r"vertices\[3\]: .* is not finite"),
        (([*VERTICES[:3], [np.inf, 0.0]], EDGES, LETTERS), r"vertices\[3\]: .* is not finite"),
        ((np.zeros((0, 2)), EDGES, LETTERS), "vertices: there are none"),
        ((VERTICES, np.array(EDGES, float), LETTERS), "edges: dtype float64, expected whole numbers"),
        ((VERTICES, [[0, 1, 2]], LETTERS), r"edges: shape \(1, 3\)"),
        ((VERTICES, [*EDGES[:4], [0, 4]], LETTERS), r"edges\[4\] = \[0, 4\]: .* 0 to 3"),
        ((VERTICES, [*EDGES[:4], [0, -1]], LETTERS), r"edges\[4\]"),
        ((VERTICES, EDGES, LETTERS[:4]), "assignment: 4 letters for 5 edges"),
        ((VERTICES, EDGES, [*LETTERS[:4], "X"]), r"assignment\[4\] = \"X\""),
        ((VERTICES, EDGES, 5), "assignment: expected a letter"),
        ((VERTICES,), "needs edges and assignment"),
    ],
)
def test_arrays_of_a_pattern_are_refused_by_name(arguments: tuple[Any, ...], words: str) -> None:
    with pytest.raises(foldmotion.BadInput, match=words):
        foldmotion.fold_pattern(*arguments)


def test_fold_angles_are_refused_by_name() -> None:
    for angles, words in [([1.0], "1 values for 5 edges"), ([np.nan] * 5, r"fold_angles\[0\]")]:
        with pytest.raises(foldmotion.BadInput, match=words):
            foldmotion.fold_pattern(VERTICES, EDGES, LETTERS, fold_angles=angles)


def test_a_pattern_of_arrays_folds_to_its_angle() -> None:
    result = foldmotion.fold_pattern(
        np.array(VERTICES), np.array(EDGES, np.int32), LETTERS, fold_angles=[0, 0, 0, 0, 90.0],
        settings={"motion.frames": 8},
    )
    assert result.outcome == "folded"
    crease = list(result.assignment).index("V")
    assert abs(result.motion.fold_angles[-1, crease] - 90.0) < 0.5


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"sheet": {"width": float("nan")}}, "sheet.width: NaN is not a finite number"),
        ({"sheet": {"width": np.float64("inf")}}, "sheet.width: inf is not a finite number"),
        ({"sheet": {"rows": 1 << 80}}, "sheet.rows: .* is too large"),
        ({"sheet": object()}, "sheet: a object cannot be a value"),
        ({1: 2}, "1 is no name"),
        ({"sheet": {"widht": 5.0}}, "widht"),
        ({"sheet": {"rows": "seven"}}, "seven"),
    ],
)
def test_values_of_a_scene_are_refused_by_key(values: dict[Any, Any], words: str) -> None:
    with pytest.raises(foldmotion.BadInput, match=words):
        foldmotion.Scene.from_dict(values)


def test_values_that_contain_themselves_are_refused() -> None:
    values: dict[str, Any] = {}
    values["sheet"] = values
    with pytest.raises(foldmotion.BadInput, match="nested too deeply"):
        foldmotion.Scene.from_dict(values)


def test_arrays_may_stand_in_a_scene() -> None:
    points = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [3.0, 0.0]])
    scene = foldmotion.Scene.from_dict({"profile": {"control_points": points, "closed": None}})
    assert "control_points = [[0.0, 0.0]" in scene.to_toml()


def test_a_scene_does_not_change() -> None:
    scene = foldmotion.Scene.from_dict(SMALL)
    study = scene.resolve()
    with pytest.raises(AttributeError):
        scene.title = "other"  # type: ignore[attr-defined]
    other = scene.replace({"sheet.columns": 2})
    assert len(other.resolve().pattern.vertices) > len(study.pattern.vertices)
    assert len(study.pattern.vertices) == len(scene.resolve().pattern.vertices)
    assert study.scene.to_toml() == scene.to_toml()
    again = foldmotion.Scene.from_toml(other.to_toml())
    assert np.array_equal(again.resolve().pattern.vertices, other.resolve().pattern.vertices)


def test_arguments_are_refused_before_any_work(small: foldmotion.Result, tmp_path: pathlib.Path) -> None:
    study = small.scene.resolve()
    with pytest.raises(foldmotion.BadInput, match="threads = 0"):
        study.run(threads=0)
    with pytest.raises(foldmotion.BadInput, match="progress"):
        study.run(progress=5)  # type: ignore[arg-type]
    with pytest.raises(foldmotion.BadInput, match="tolerance"):
        foldmotion.check(small, tolerance=1.0)
    with pytest.raises(foldmotion.BadInput, match="motion: expected"):
        foldmotion.check(5)  # type: ignore[arg-type]
    with pytest.raises(foldmotion.BadInput, match="certificate: expected"):
        foldmotion.verify(small, 5)  # type: ignore[arg-type]
    with pytest.raises(foldmotion.BadInput, match="count = 1"):
        study.profile_points(1)
    with pytest.raises(foldmotion.BadInput, match="outputs"):
        small.record(tmp_path / "a", ["film"])
    with pytest.raises(foldmotion.BadInput, match="sizes"):
        small.write_gif(tmp_path / "a.gif", sizes=(1, 2))
    with pytest.raises(foldmotion.BadInput, match="--size"):
        small.write_gif(tmp_path / "a.gif", size=(0, 2))
    assert list(tmp_path.iterdir()) == []


def test_outputs_that_cannot_be_written_are_errors(small: foldmotion.Result, tmp_path: pathlib.Path) -> None:
    with pytest.raises(foldmotion.OutputError):
        small.write_svg(tmp_path / "none" / "a.svg")
    (tmp_path / "file").write_text("")
    with pytest.raises(foldmotion.OutputError, match="it is a file, not a folder"):
        small.save(tmp_path / "file")
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "motion.gif").write_text("mine")
    with pytest.raises(foldmotion.OutputError, match="motion.gif"):
        small.save(tmp_path / "own")
    assert (tmp_path / "own" / "motion.gif").read_text() == "mine"
    assert "motion.gif" in small.save(tmp_path / "own", force=True).files


def test_several_threads_use_one_result(small: foldmotion.Result, tmp_path: pathlib.Path) -> None:
    result = small.scene.resolve().run()
    found: list[tuple[int, str]] = []

    def use(index: int) -> None:
        positions = result.motion.positions
        result.write_svg(tmp_path / f"{index}.svg")
        found.append((positions.__array_interface__["data"][0], result.certificate.sha256))

    threads = [threading.Thread(target=use, args=(index,)) for index in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8 and len(set(found)) == 1
    assert len({path.read_bytes() for path in tmp_path.iterdir()}) == 1


def test_a_file_that_is_no_motion_is_refused(scenes: pathlib.Path, tmp_path: pathlib.Path) -> None:
    with pytest.raises(foldmotion.BadInput, match="fold_pattern"):
        foldmotion.read_fold(scenes / "one-unit.toml")
    (tmp_path / "broken.fold").write_text('{"vertices_coords": [[0, 0], [1')
    with pytest.raises(foldmotion.BadInput, match="broken.fold"):
        foldmotion.check(tmp_path / "broken.fold")
