"""Results, outcomes, proofs, recordings and tables."""

from __future__ import annotations

import html
import pathlib
import re
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as ElementTree

import foldmotion
import numpy as np
import pytest


def test_progress_names_the_phases_and_stops_the_run(scenes: pathlib.Path) -> None:
    heard: list[tuple[str, float]] = []
    caller: set[int] = set()

    def progress(phase: str, done: float) -> None:
        heard.append((phase, done))
        caller.add(threading.get_ident())

    study = foldmotion.Scene.from_file(scenes / "shelter-e.toml").resolve()
    study.run(progress=progress)
    assert {phase for phase, _ in heard} <= {"read", "fold", "check"} and heard
    assert all(0.0 <= done <= 1.0 for _, done in heard)
    assert caller == {threading.get_ident()}
    with pytest.raises(foldmotion.Interrupted, match="interrupted"):
        study.run(progress=lambda phase, done: False)
    with pytest.raises(ZeroDivisionError):
        study.run(progress=lambda phase, done: 1 / 0)


def test_other_threads_work_during_a_run(scenes: pathlib.Path) -> None:
    study = foldmotion.Scene.from_file(scenes / "shelter-e.toml").resolve()
    counted, over = 0, threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    study.run()
    over.set()
    thread.join()
    assert counted > 20


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_stops_a_run_and_the_interpreter_lives_on(scenes: pathlib.Path) -> None:
    program = f"""
import foldmotion, signal, threading, os
scene = foldmotion.Scene.from_file({str(scenes / "shelter-e.toml")!r})
study = scene.replace({{"sheet.rows": 30, "sheet.columns": 30}}).resolve()
threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    study.run()
except KeyboardInterrupt:
    print("stopped", len(foldmotion.models()) > 0)
"""
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert ran.stdout == "stopped True\n"


def test_a_jam_is_a_result_and_an_exception_only_on_request(scenes: pathlib.Path) -> None:
    scene = foldmotion.Scene.from_file(scenes / "one-row.toml").replace({"motion.budget": "3steps"})
    result = scene.resolve().run()
    assert result.outcome == "stopped" and result.status == 3
    with pytest.raises(foldmotion.Stopped) as stopped:
        result.raise_for_outcome()
    assert stopped.value.result is result
    assert str(stopped.value) == result.line
    assert isinstance(stopped.value, foldmotion.OutcomeError | foldmotion.Error)
    with pytest.raises(foldmotion.Stopped):
        scene.resolve().run(check=True)


def test_a_penetration_is_a_result(scenes: pathlib.Path) -> None:
    scene = foldmotion.Scene.from_file(scenes / "shelter-short-plain.toml")
    result = scene.resolve().run(check=True)
    assert (result.outcome, result.verdict, result.status) == ("collides", "penetrating", 1)
    assert len(result.certificate.penetrations) > 0


def test_reports_are_attributes_and_dictionaries(small: foldmotion.Result) -> None:
    report = small.report
    assert report.outcome.kind == small.outcome == report["outcome"]["kind"]
    assert report.to_dict()["stages"][0]["name"] == report.stages[0].name
    with pytest.raises(AttributeError, match="there is no nonsense"):
        report.nonsense  # noqa: B018
    with pytest.raises(AttributeError, match="does not change"):
        report.title = "other"
    copy = report.to_dict()
    copy["title"] = "other"
    assert report.title == "small"


def test_proofs_accept_what_is_true_and_refute_what_is_not(
    small: foldmotion.Result, tmp_path: pathlib.Path
) -> None:
    small.save(tmp_path)
    motion = foldmotion.read_fold(tmp_path / "motion.fold")
    assert np.allclose(motion.positions, small.motion.positions, rtol=0, atol=0)
    assert np.array_equal(motion.times, small.motion.times)
    for checked in (tmp_path / "motion.fold", motion, small, small.motion):
        certificate = foldmotion.check(checked)
        assert certificate.verdict == small.verdict
        assert foldmotion.verify(checked, certificate).is_verified
    verified = foldmotion.verify(tmp_path / "motion.fold", tmp_path / "certificate.json")
    assert verified.is_verified and verified.status == 0 and verified.line.startswith("VERIFIED")
    false = small.certificate.to_json().replace('"vertices": ', '"vertices": 1')
    (tmp_path / "false.json").write_text(false)
    refuted = foldmotion.verify(small, tmp_path / "false.json")
    assert refuted.status == 2 and not refuted.is_verified and "vertices" in refuted.line


def test_every_kind_of_file_is_written(small: foldmotion.Result, tmp_path: pathlib.Path) -> None:
    starts = {
        "gif": b"GIF89a", "mp4": b"\0\0\0", "pdf": b"%PDF", "svg": b"<svg", "glb": b"glTF", "html": b"<!doctype"
    }
    for ending, start in starts.items():
        path = tmp_path / f"film.{ending}"
        getattr(small, f"write_{ending}")(path, size=(96, 72), fps=2)
        assert path.read_bytes()[: len(start)].lower() == start.lower(), ending
    assert sorted(path.suffix[1:] for path in tmp_path.iterdir()) == sorted(starts)
    names = small.write_vtk(tmp_path / "vtk")
    assert set(names) == {"motion.pvd", *(f"vtk/{n:04}.vtp" for n in range(1, len(small.motion) + 1))}


def test_frames_of_a_longer_motion_are_not_left_beside_a_shorter_one(
    small: foldmotion.Result, tmp_path: pathlib.Path
) -> None:
    shorter = small.scene.replace({"motion.frames": 4}).resolve().run()
    assert len(shorter.motion) < len(small.motion)
    (tmp_path / "vtk").mkdir()
    (tmp_path / "vtk" / "mine.txt").write_text("mine")
    small.write_vtk(tmp_path)
    names = shorter.write_vtk(tmp_path)
    left = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*.[pv]*") if path.is_file()}
    assert left == set(names)
    assert (tmp_path / "vtk" / "mine.txt").read_text() == "mine"
    files = ElementTree.parse(tmp_path / "motion.pvd").getroot().findall("./Collection/DataSet")
    assert [float(file.attrib["timestep"]) for file in files] == shorter.motion.times.tolist()


def test_series_are_taken_over_by_three_libraries(small: foldmotion.Result) -> None:
    series, motion = small.series(), small.motion
    pyarrow = pytest.importorskip("pyarrow")
    polars = pytest.importorskip("polars")
    pandas = pytest.importorskip("pandas")
    table = pyarrow.table(series)
    assert table.column_names == series.columns
    assert table["t"].to_pylist() == motion.times.tolist()
    assert np.allclose(table["peak_facet_bending_deg"], motion.bending.max(axis=1), rtol=0, atol=1e-9)
    assert np.allclose(table["peak_strain"], motion.strain.max(axis=1) / 100, rtol=0, atol=1e-11)
    assert polars.DataFrame(series)["t"].to_list() == motion.times.tolist()
    frame = pandas.DataFrame.from_arrow(series) if hasattr(pandas.DataFrame, "from_arrow") else table.to_pandas()
    assert frame["stage"].tolist() == table["stage"].to_pylist()


def test_notebooks_show_a_page_without_network_and_a_drawing(small: foldmotion.Result) -> None:
    shown = small._repr_html_()
    frame = re.fullmatch(r'<iframe sandbox="allow-scripts" [^>]*srcdoc="([^"]*)"></iframe>', shown)
    assert frame
    page = html.unescape(frame[1])
    assert page.lower().startswith("<!doctype html>") and "Content-Security-Policy" in page
    assert not re.search(r'(src|href)="https?:', page)
    drawing = ElementTree.fromstring(small.pattern._repr_svg_().encode())
    assert drawing.tag.endswith("svg")


def test_models_are_those_of_scenes() -> None:
    models = foldmotion.models()
    assert {"shelter", "chair"} <= {model.name for model in models}
    for model in models[:3]:
        scene = foldmotion.Scene.from_dict({"profile": {"model": model.name}})
        assert len(scene.resolve().division) == model.rows + 1  # type: ignore[arg-type]


def test_imported_patterns_have_no_profile(scenes: pathlib.Path) -> None:
    study = foldmotion.Scene.from_file(scenes / "imported" / "miura.svg").resolve()
    assert study.division is None and study.compact is None and study.profile_points() is None
    assert study.closed_form is None and study.start.shape == study.planar.shape
    assert set(study.pattern.assignment) <= set("MVBFU")
