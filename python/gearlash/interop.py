"""Plants and controllers of scipy.signal and python-control, and a describing function for theirs.

Systems are known by their attributes, so that neither package is needed to import this module:
``num``, ``den`` and ``dt`` (python-control nests the coefficients of one input and one output),
``zeros``, ``poles`` and ``gain``, or ``A``, ``B``, ``C``, ``D``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlash import _core
from gearlash._arguments import number, one_of
from gearlash._motion import _numbers

_NEGLIGIBLE = 1e-9  # of the largest coefficient


def _coefficients(name: str, found: Any) -> NDArray[np.float64]:
    """The coefficients of one input and one output, which python-control nests twice."""
    while np.ndim(found) and np.ndim(found[0]):
        if len(found) != 1:
            raise ValueError(f"{name} must be of one input and one output, not of {len(found)}")
        found = found[0]
    return np.atleast_1d(_numbers(name, found))


def _polynomials(system: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    if not hasattr(system, "num") and hasattr(system, "to_tf"):  # zeros and poles of SciPy
        system = system.to_tf()
    if not (hasattr(system, "num") and hasattr(system, "den")):
        raise TypeError("a system must have num and den, zeros, poles and gain, or A, B, C and D, "
                        f"not be a {type(system).__name__}")
    num, den = (np.trim_zeros(_coefficients(name, getattr(system, name)), "f")
                for name in ("num", "den"))
    if den.size == 0:
        raise ValueError("den must not be 0")
    if num.size > den.size:
        raise ValueError(f"num must be of no higher degree than den, not {num.tolist()} over "
                         f"{den.tolist()}")
    return num, den


def _period(system: Any) -> float | None:
    """The sampling period, s; None of a continuous system. python-control has 0 for these."""
    step = getattr(system, "dt", None)
    if step is None or step is False or (step == 0 and step is not True):
        return None
    if step is True or not np.isfinite(step) or step < 0:
        raise ValueError(f"dt must be the sampling period in s, not {step}")
    return float(step)


def controller(system: Any, *, shaft: str = "mixed") -> dict[str, dict[str, Any]]:
    """Give the sections of a drive whose controller is a linear system of the error.

    Parameters
    ----------
    system : scipy.signal.lti or dlti, control.TransferFunction or control.StateSpace
        From the error of the position, rad, to the motor's torque, N m, or voltage, V. Of one input
        and one output, proper. A system in z has its sampling period as ``dt``, s.
    shaft : str
        Where errors and torques are: "load", "motor", or "mixed" (the load's angle, the motor's
        torque).

    Returns
    -------
    dict
        ``controller``, and ``sampling`` for a system in z: ``Drive(motor=…, **controller(system))``.

    Raises
    ------
    TypeError
        For something else than a linear system.
    ValueError
        For several inputs or outputs, and a system in z without a sampling period.

    Examples
    --------
    >>> import gearlash
    >>> from scipy import signal
    >>> lead = signal.TransferFunction([0.05, 20.0], [0.001, 1.0])
    >>> joint = gearlash.Drive(
    ...     motor={"kind": "torque-controlled", "inertia": 2e-6, "friction": 1e-5},
    ...     gearbox={"ratio": 20, "backlash": 2e-3}, load={"inertia": 5e-3, "friction": 1e-3},
    ...     **gearlash.interop.controller(lead))
    >>> joint.controller.num, joint.controller.den  # SciPy divides by the leading coefficient
    ([50, 20000], [1, 1000])
    """
    one_of("shaft", shaft, ("load", "motor", "mixed"))
    if all(hasattr(system, name) for name in "ABCD") and not hasattr(system, "num"):
        return _state_space(system, shaft)
    num, den = _polynomials(system)
    period = _period(system)
    section: dict[str, Any] = {"kind": "transfer-function", "shaft": shaft, "gain": 1.0,
                               "num": num.tolist(), "den": den.tolist()}
    if period is None:
        return {"controller": section}
    return {"controller": {**section, "variable": "z"}, "sampling": {"period": period}}


def _state_space(system: Any, shaft: str) -> dict[str, dict[str, Any]]:
    A, B, C, D = (np.atleast_2d(_numbers(name, getattr(system, name))) for name in "ABCD")
    if B.shape[1] != 1 or C.shape[0] != 1 or D.size != 1:
        raise ValueError("a system must have one input and one output, "
                         f"not B of shape {B.shape} and C of shape {C.shape}")
    if _period(system) is not None:
        raise ValueError("a state space must be continuous; give one in z as a transfer function")
    return {"controller": {"kind": "state-space", "shaft": shaft, "gain": 1.0, "A": A.tolist(),
                           "B": B.tolist(), "C": C[0].tolist(), "D": D[0].tolist()}}


def shaft(system: Any) -> dict[str, float]:
    """Give inertia and viscous friction of a shaft from its transfer function.

    Parameters
    ----------
    system : scipy.signal.lti or control.TransferFunction
        From the torque, N m, on the shaft to its position, k/(J s² + F s), or to its speed,
        k/(J s + F).

    Returns
    -------
    dict
        ``inertia``, kg m², and ``friction``, N m s/rad: ``Drive(load=shaft(plant), …)``.

    Raises
    ------
    TypeError
        For something else than a linear system.
    ValueError
        For a system that is neither.

    Examples
    --------
    >>> import gearlash
    >>> from scipy import signal
    >>> gearlash.interop.shaft(signal.TransferFunction([2.0], [0.01, 0.002, 0.0]))
    {'inertia': 0.005, 'friction': 0.001}
    """
    num, den = _polynomials(system)
    if _period(system) is not None:
        raise ValueError("a shaft must be given by a continuous system")
    of_position = den.size == 3 and abs(den[2]) <= _NEGLIGIBLE * np.abs(den).max()
    if num.size != 1 or not (of_position or den.size == 2):
        raise ValueError("a shaft must be k/(J s² + F s), torque to position, or k/(J s + F), torque "
                         f"to speed, not {num.tolist()}/{den.tolist()}")
    found = {"inertia": float(den[0] / num[0]), "friction": float(den[1] / num[0])}
    if not (found["inertia"] > 0.0 and found["friction"] >= 0.0):
        raise ValueError("a shaft must have an inertia above 0 and a friction from 0 on, not "
                         f"{found['inertia']:g} kg m² and {found['friction']:g} N m s/rad")
    return found


class InertiaBacklash:
    """The describing function of a gap whose load keeps its speed while the gap is crossed.

    It has the methods of python-control's ``DescribingFunctionNonlinearity``:
    ``control.describing_function_response(system, InertiaBacklash(b), amplitudes)``. That package
    has the gap driven by friction, ``friction_backlash_nonlinearity``.

    Parameters
    ----------
    b : float
        The gap, face to face, in the unit of the input.

    Notes
    -----
    With the contact at the angle c after the fastest point, c − sin c = b/A,
    N = 1 − (c − 2 sin c + sin c cos c)/π − j (1 − cos c)²/π, for A ≥ b/π; nan below, where the
    response may repeat only after several periods. Derived in docs/explanation.

    Examples
    --------
    >>> import gearlash
    >>> gap = gearlash.interop.InertiaBacklash(0.3)
    >>> gain = gap.describing_function(1.0)
    >>> complex(round(gain.real, 6), round(gain.imag, 6))
    (1.110801-0.148605j)
    """

    def __init__(self, b: float) -> None:
        self.b = number("b", b)
        _core.describing_gain(self.b, np.array([1.0]))  # refuses a bad gap

    def describing_function(self, A: ArrayLike) -> Any:
        """Give the complex gain N(A) for amplitudes A > 0 of any shape."""
        amplitudes = _numbers("A", A)
        gains = _core.describing_gain(self.b, amplitudes.reshape(-1)).reshape(amplitudes.shape)
        return gains if gains.ndim else complex(gains)

    def __call__(self, x: float) -> float:
        raise NotImplementedError("the load's speed is not a function of the input alone; "
                                  "use describing_function(A), or gearlash.simulate")

    def _isstatic(self) -> bool:
        return False

    def _f(self, x: float) -> float:
        return self(x)

    def __repr__(self) -> str:
        return f"InertiaBacklash({self.b!r})"
