"""Python and the command line of the wheel write the same bytes and say the same words."""

from __future__ import annotations

import json
import pathlib
import signal
import subprocess
import sys
import time
from typing import Any

import foldmotion
import pytest

PROGRAM = [str(pathlib.Path(sys.executable).with_name("foldmotion"))]


def run(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)


def without_timings(report: str) -> dict[str, Any]:
    values: dict[str, Any] = json.loads(report)
    for key in ("seconds", "device"):
        values["engine"].pop(key)
    values.pop("seconds")
    if values.get("division"):
        values["division"].pop("seconds", None)
    return values


def test_a_saved_run_has_the_bytes_of_the_command_line(
    one_unit: foldmotion.Result, scenes: pathlib.Path, tmp_path: pathlib.Path
) -> None:
    ran = run("run", scenes / "one-unit.toml", "--out", tmp_path / "line", "--quiet")
    assert ran.returncode == one_unit.status == 0, ran.stderr
    report = one_unit.save(tmp_path / "python")
    names = {file.name for file in (tmp_path / "line").iterdir()}
    assert names >= {"motion.fold", "certificate.json", "motion.gif", "motion.csv", "plots.svg"}
    assert names == {file.name for file in (tmp_path / "python").iterdir()}
    for name in names - {"report.json", ".foldmotion.json"}:
        assert (tmp_path / "line" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name
    texts = [(tmp_path / place / "report.json").read_text() for place in ("line", "python")]
    assert without_timings(texts[0]) == without_timings(texts[1])
    assert report.to_json() == texts[1]
    # Line by line, what differs is a number of seconds.
    lines = [text.splitlines() for text in texts]
    assert len(lines[0]) == len(lines[1])
    differing = {a.split(":")[0].strip() for a, b in zip(*lines, strict=True) if a != b}
    assert differing <= {'"seconds"', '"check"', '"record"', '"total"'}


def test_certificates_in_memory_are_the_file(
    one_unit: foldmotion.Result, tmp_path: pathlib.Path
) -> None:
    one_unit.save(tmp_path)
    assert one_unit.certificate.to_json() == (tmp_path / "certificate.json").read_text()


@pytest.mark.parametrize(
    ("key", "value"), [("sheet.width", -5), ("sheet.nonsense", 1), ("sheet.case", "round")]
)
def test_errors_have_the_words_of_the_command_line(
    scenes: pathlib.Path, key: str, value: object
) -> None:
    ran = run("run", scenes / "one-unit.toml", "--set", f"{key}={value}", "--quiet")
    assert ran.returncode == 2
    scene = foldmotion.Scene.from_file(scenes / "one-unit.toml")
    with pytest.raises(foldmotion.BadInput) as refused:
        scene.replace({key: value}).resolve()
    assert ran.stderr == f"foldmotion: {refused.value}\n"
    assert refused.value.status == 2


def test_a_missing_file_is_refused_in_the_same_words(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "none.toml"
    with pytest.raises(foldmotion.BadInput) as refused:
        foldmotion.Scene.from_file(path)
    assert run("run", path).stderr == f"foldmotion: {refused.value}\n"


def test_the_console_script_lists_the_models_and_knows_its_version() -> None:
    listed = run("models").stdout
    assert all(model.name in listed for model in foldmotion.models())
    assert run("--version").stdout == f"foldmotion {foldmotion.__version__}\n"
    assert run("no-such-command").returncode == 2


def test_the_module_is_the_same_program() -> None:
    ran = subprocess.run(
        [sys.executable, "-m", "foldmotion", "models"], capture_output=True, text=True, check=True
    )
    assert ran.stdout == run("models").stdout


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_the_console_script(scenes: pathlib.Path, tmp_path: pathlib.Path) -> None:
    arguments = ["run", str(scenes / "shelter-e.toml"), "--out", str(tmp_path / "out")]
    larger = ["--set", "sheet.rows=30", "--set", "sheet.columns=30"]
    with subprocess.Popen([*PROGRAM, *arguments, *larger], stderr=subprocess.PIPE, text=True) as program:
        assert program.stderr is not None
        while not program.stderr.readline().startswith("fold"):
            pass
        program.send_signal(signal.SIGINT)
        started = time.monotonic()
        said = program.stderr.read()
        assert program.wait() == 3
    assert "interrupted; earlier results are untouched" in said
    assert time.monotonic() - started < 30
    assert not (tmp_path / "out").exists()
