"""N. C. New's thesis of 1960: its program, its printout and its charts."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearlash import _core
from gearlash._arguments import number, whole
from gearlash._records import SettledCycle

#: The columns of a printout.
COLUMNS = ("time", "motor_speed", "motor_position", "load_speed", "load_position")


def table_2() -> NDArray[np.float64]:
    """Give Table II as the thesis prints it.

    Returns
    -------
    array, shape (38, 5)
        Columns as :data:`COLUMNS`; ω_n = 1 rad/s, a step of 1 rad.
    """
    return _core.thesis_table_2()


def printout(lines: int = 38, servo: tuple[float, float, float, float] | None = None, *,
             machine: bool = False) -> NDArray[np.float64]:
    """Run the program of Table I and give what it prints.

    Parameters
    ----------
    lines : int
        How many.
    servo : (damping, inertia_ratio, friction_ratio, backlash), optional
        Default the servo of Table II.
    machine : bool
        Run the octal words on the emulated CDC 1604, in its own 48-bit arithmetic; otherwise the
        readable port in double precision.

    Returns
    -------
    array, shape (lines, 5)
        Columns as :data:`COLUMNS`.

    Raises
    ------
    InvalidInput
        Unless both inertias are positive.

    Examples
    --------
    >>> from gearlash import thesis
    >>> thesis.printout(2)[:, 0].tolist()
    [0.08, 0.16]
    """
    if servo is not None:
        if isinstance(servo, str) or len(tuple(servo)) != 4:
            raise ValueError("servo must be four numbers: damping, inertia_ratio, friction_ratio "
                             f"and backlash, not {servo!r}")
        servo = _four(*servo)
    return _core.thesis_printout(whole("lines", lines, 0, 1_000_000), servo, machine)


def _four(damping: float, inertia_ratio: float, friction_ratio: float, backlash: float
          ) -> tuple[float, float, float, float]:
    return (number("damping", damping), number("inertia_ratio", inertia_ratio),
            number("friction_ratio", friction_ratio), number("backlash", backlash))


def run(damping: float, inertia_ratio: float, friction_ratio: float, backlash: float = 0.3, *,
        machine: bool = False) -> SettledCycle:
    """Run the program of 1960 until its cycle has settled.

    Parameters are those of :func:`printout`. Its amplitudes are 1 to 4 % too large.

    Examples
    --------
    >>> from gearlash import thesis
    >>> thesis.run(0.19, 2, 0.1).amplitude > 0.241611108
    True
    """
    return _core.thesis_run(*_four(damping, inertia_ratio, friction_ratio, backlash), machine)


def figures() -> list[dict[str, Any]]:
    """Compute figures 2 to 11: amplitudes over friction ratio, backlash or inertia ratio.

    Returns
    -------
    list of dict
        ``number``, ``caption`` and ``curves``; each curve has ``name``, ``exact`` (array, shape
        (n, 2): place and amplitude in rad) and ``program`` (the points of 1960, likewise).
    """
    return _core.thesis_figures()
