"""Limit cycles of geared servos with backlash: will it hunt, how large and fast, and what to change.

>>> import gearlash
>>> drive = gearlash.Drive.normal_form(damping=0.19, inertia_ratio=2, friction_ratio=0.1,
...                                    backlash=0.3)
>>> print(gearlash.analyse(drive).headline)
hunts: ±0.242 rad, period 6.456 / ω_n (proved)

All numbers are in SI. Functions that take long release the interpreter's lock, use all cores, take
``progress=`` and are stopped by Ctrl-C. Results are the same to the bit as the tool's.
"""

from gearlash import _core, distributed, interop, thesis
from gearlash._analysis import Report, analyse, derivatives, describe, quantities
from gearlash._design import (design, margins, sensitivity_indices, series, target, tolerance, tune,
                              widest_backlash)
from gearlash._drive import Drive, Section
from gearlash._errors import InvalidInput
from gearlash._motion import Motion, Samples, simulate
from gearlash._records import *  # noqa: F403
from gearlash._records import __all__ as _records_all
from gearlash._sweep import Table, axis, compare, linear, logarithmic, sweep, verdict_words

__version__: str = _core.__version__


def __getattr__(name: str) -> object:
    """Import :mod:`gearlash.plot`, and Matplotlib with it, where it is first named."""
    if name == "plot":
        import importlib

        return importlib.import_module("gearlash.plot")
    raise AttributeError(f"module gearlash has no attribute {name}")


__all__ = [
    "Drive", "InvalidInput", "Motion", "Report", "Samples", "Section", "Table", "analyse", "axis",
    "compare", "derivatives", "describe", "design", "linear", "logarithmic", "margins",
    "distributed", "interop", "quantities", "sensitivity_indices", "series", "simulate", "sweep", "target", "tolerance",
    "thesis", "tune", "verdict_words", "widest_backlash", *_records_all,
]
