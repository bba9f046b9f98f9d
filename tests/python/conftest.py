"""Drives and the tool, for all tests of the Python module."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, os.environ.get("GEARLASH_PYTHON", str(ROOT / "build/release/python")))

import gearlash  # noqa: E402

TOOL = os.environ.get("GEARLASH_TOOL", str(ROOT / "build/release/gearlash"))


@pytest.fixture
def servo():
    """The sample servo of DESIGN: amplitude 0.241611108 rad, period 6.456205 s."""
    return gearlash.Drive.normal_form(damping=0.19, inertia_ratio=2, friction_ratio=0.1,
                                      backlash=0.3)


@pytest.fixture
def pd_drive():
    """A drive without a closed form that is searched in a tenth of a second."""
    return gearlash.Drive(
        motor={"kind": "torque-controlled", "inertia": "20 g cm^2", "friction": 1e-5},
        gearbox={"ratio": 20, "backlash": "2 mrad"},
        load={"inertia": 5e-3, "friction": 1e-3},
        controller={"kind": "PD", "proportional": 20.0, "derivative": 0.02, "filter": "1 ms"})


@pytest.fixture
def example():
    """A file of examples/."""
    return lambda name: ROOT / "examples" / name


@pytest.fixture
def tool():
    """Runs the tool and gives its standard output."""

    def run(*arguments):
        # A sanitizer's runtime, which the interpreter needs, stands in the tool already.
        environment = {key: value for key, value in os.environ.items() if key != "LD_PRELOAD"}
        done = subprocess.run([TOOL, *map(str, arguments)], capture_output=True, text=True,
                              check=False, timeout=300, env=environment)
        assert done.returncode in (0, 1), done.stderr
        return done.stdout

    return run
