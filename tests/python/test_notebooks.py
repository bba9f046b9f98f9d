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
    assert [path.name for path in tmp_path.iterdir()] == ["printout-of-1960.pdf"]
