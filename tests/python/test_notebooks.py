"""The notebooks of examples/python run as plain scripts, without a screen."""

import os
import re
import subprocess
import sys
from pathlib import Path

from conftest import ROOT

NOTEBOOKS = ROOT / "examples" / "python"


def run(name: str, *arguments: str) -> str:
    package = os.environ.get("GEARLASH_PYTHON", str(ROOT / "build/release/python"))
    done = subprocess.run([sys.executable, str(NOTEBOOKS / name), *arguments], timeout=120,
                          capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": package, "MPLBACKEND": "Agg"})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_printout_agrees_with_the_table_within_its_last_digit(tmp_path: Path) -> None:
    output = run("printout_of_1960.py", str(tmp_path))
    differences = [float(text) for text in re.findall(r"\d\.\d+e-\d+", output)]
    assert len(differences) == 10
    assert max(differences) <= 1.01e-7
    # The program of 1960 is a few thousandths off the exact motion in its first three seconds.
    assert 0.001 < float(re.search(r"exact motion: ([\d.]+) rad", output)[1]) < 0.005
    assert [path.name for path in tmp_path.iterdir()] == ["printout-of-1960.pdf"]


def figures(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_design_chart_has_the_border_of_hunting(tmp_path: Path) -> None:
    output = run("design_chart.py", str(tmp_path))
    assert "hunts: ±22.8 arcmin at 3.91 Hz" in output
    counts = {word: int(count) for word, count in re.findall(r"^([a-z ]+): (\d+) of 961", output,
                                                             re.M)}
    assert sum(counts.values()) == 961
    assert counts["cannot hunt"] > 50 and counts["hunts"] > 300
    assert figures(tmp_path) == ["design-chart.png"]


def test_tolerance_study_gives_the_share_that_hunts(tmp_path: Path) -> None:
    assert "0.6730 of the samples hunt" in run("tolerance_study.py", str(tmp_path))
    assert figures(tmp_path) == ["tolerance-study.png"]


def test_sensor_at_the_motor_brings_the_drive_to_rest(tmp_path: Path) -> None:
    output = run("sensor_before_or_after_the_gap.py", str(tmp_path))
    assert "sensor at the load: hunts: ±22.8 arcmin" in output
    assert "sensor at the motor: comes to rest" in output
    assert figures(tmp_path) == ["sensor-at-the-load.png", "sensor-at-the-motor.png"]
