"""The questions: what does a drive do, and how does it depend on its numbers?"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable, Sequence
from typing import Any, Optional

from gearlash import _core
from gearlash._arguments import where_given
from gearlash._drive import Drive
from gearlash._records import Answer, Jacobian, QuantityInfo, Wanted

Progress = Optional[Callable[[float], Optional[bool]]]


def analyse(drive: Drive, *, proofs: bool = True, ceiling: bool = True, loop: bool = False,
            step: bool = False, borders: bool = True, causes: bool = True,
            motion_bytes: int | None = None, progress: Progress = None) -> Answer:
    """Report whether a drive hunts, how large and fast, and how certain that is.

    The closed form answers for the servo of 1960 and every drive that is one by its physics, in
    microseconds. Every other drive is simulated from several starts, in seconds.

    Parameters
    ----------
    drive : Drive
    proofs : bool
        Prove the verdict by interval arithmetic where the closed form answers.
    ceiling : bool
        Add the proved bound of every motion.
    loop : bool
        Add bandwidth, margins and lag of the linear loop.
    step : bool
        Add the response to a step of the reference, of the size of ``specification.step``.
    borders : bool
        Search what lies between starts that end differently: unstable cycles, and from which step
        on a drive hunts.
    causes : bool
        Search once more without gap, dry friction, integral action, delay, encoder and load torque,
        each by itself: ``without`` and ``is_quantization``.
    motion_bytes : int, optional
        That a search keeps of a motion at most, but for its last thousand steps; default 64,000,000.
        It takes two to three times as many in all.
    progress : callable, optional
        Called with the share of the work done, 0 … 1. If it returns False the work stops, and the
        answer is what is known by then. Ctrl-C raises KeyboardInterrupt.

    Returns
    -------
    Answer
        With ``verdict``, ``cycles``, ``rest``, ``ceiling`` and so on, in SI. ``print(answer)``
        prints the report.

    Raises
    ------
    InvalidInput
        For a faulty drive.

    Notes
    -----
    The method is that of docs/explanation: the return map of N. C. New's servo (1960), and a search
    over piecewise-affine motions with certified events.

    Examples
    --------
    >>> import gearlash
    >>> answer = gearlash.analyse(gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3))
    >>> answer.verdict, answer.certainty
    ('hunts', 'enclosed')
    >>> round(answer.cycles[0].amplitude, 9), round(answer.cycles[0].period, 6)
    (0.241611108, 6.456205)
    """
    wanted = Wanted(proofs=proofs, ceiling=ceiling, loop=loop, step=step, borders=borders,
                    causes=causes, **where_given(motion_bytes=motion_bytes))
    return dataclasses.replace(_core.analyse(drive, wanted, progress), drive=drive)


def derivatives(drive: Drive, quantities: Sequence[str], parameters: Sequence[str], *,
                progress: Progress = None) -> Jacobian:
    """Give derivatives of the limit cycle with respect to parameters.

    Parameters
    ----------
    drive : Drive
    quantities : sequence of str
        With a closed form amplitude, period, frequency, multiplier and growth_at_rest; of other
        drives amplitude, motor_amplitude, center, period and frequency.
    parameters : sequence of str
        Paths of numbers.
    progress : callable, optional
        As of :func:`analyse`.

    Returns
    -------
    Jacobian
        In SI. ``reason`` says why a cycle has no derivatives.

    Raises
    ------
    InvalidInput
        For an unsound drive, another quantity, or a path that is no number of the drive.

    Notes
    -----
    Differences of the answers at neighbouring values, extrapolated. They agree to 1e-9 of the
    larger of derivative and value/parameter, less next to the boundary of hunting; where they agree
    to less than 1e-6 the slope is None.

    Examples
    --------
    >>> import gearlash
    >>> servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
    >>> slopes = gearlash.derivatives(servo, ["amplitude"], ["servo.backlash", "servo.damping"])
    >>> round(slopes.elasticity("amplitude", "servo.backlash"), 12)
    1.0
    """
    return _core.derivatives(drive, quantities, parameters, progress)


class Report(dict[str, Any]):
    """The JSON of a command of the tool, as a dictionary. ``print(report)`` prints its text."""

    def __init__(self, content: str, text: str) -> None:
        super().__init__(json.loads(content))
        self.text = text

    def __str__(self) -> str:
        return self.text

    def __reduce__(self) -> tuple[Any, ...]:
        return Report, (json.dumps(dict(self)), self.text)


def describe(drive: Drive, *, progress: Progress = None) -> Report:
    """Compare what describing functions predict with the exact cycle.

    Parameters
    ----------
    drive : Drive
    progress : callable, optional
        As of :func:`analyse`.

    Returns
    -------
    Report
        The JSON of ``gearlash describe`` by its keys, in SI.

    Raises
    ------
    InvalidInput
        For a drive that has no describing functions.

    Examples
    --------
    >>> import gearlash
    >>> report = gearlash.describe(gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3))
    >>> [analysis["part"] for analysis in report["analyses"]]
    ['gap, load held by friction', 'gap, load coasting']
    """
    return Report(*_core.describe(drive, progress))


def quantities() -> tuple[QuantityInfo, ...]:
    """List what can be asked of an answer: name, unit and meaning.

    Examples
    --------
    >>> import gearlash
    >>> [info.name for info in gearlash.quantities()][:4]
    ['verdict', 'growth_at_rest', 'amplitude', 'motor_amplitude']
    """
    return _core.quantities()
