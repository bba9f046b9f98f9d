"""Exact motions: samples, states at any time, and events."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlash import _core, _notebook
from gearlash._analysis import Progress
from gearlash._arguments import number, whole
from gearlash._drive import Drive
from gearlash._records import EnergyBooks, Engine, MotionStop, MotionTouch, Start

#: The fields of :attr:`Motion.events`.
EVENT = np.dtype([(name, {"what": "U48", "mode_after": "U80"}.get(name, "f8"))
                  for name in _core.FIELDS_OF_EVENTS])


class Samples(Mapping[str, NDArray[np.float64]]):
    """Columns of one length, by name or as attributes: ``samples.load_position``.

    ``time`` (s), ``load_position``, ``motor_position``, ``reference`` (rad), ``load_speed``,
    ``motor_speed`` (rad/s), ``motor_torque``, ``load_torque`` (N m). The motor's are referred to
    the load's shaft.
    """

    def __init__(self, columns: dict[str, NDArray[np.float64]]) -> None:
        self._columns = columns

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        return self._columns[name]

    def __getattr__(self, name: str) -> NDArray[np.float64]:
        if name.startswith("_") or name not in self._columns:
            raise AttributeError(f"samples have no {name}; they have {', '.join(self)}")
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, Samples) and list(self) == list(other)
                and all(np.array_equal(self[name], other[name]) for name in self))

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return Samples, ({name: np.array(column) for name, column in self._columns.items()},)

    def __repr__(self) -> str:
        return f"<Samples: {self.time.size} of {', '.join(self)}>"


class Motion:
    """The motion that :func:`simulate` gives."""

    def __init__(self, core: _core.Motion, drive: Drive,
                 span: tuple[float, Start | None, int]) -> None:
        self._core = core
        self._span = span
        #: the drive that moves
        self.drive = drive

    def sampled(self, every: float) -> Samples:
        """Give samples at 0, `every`, 2 `every`, … s up to the end, without copies.

        Raises
        ------
        InvalidInput
            Unless `every` is positive and gives at most a hundred million samples.
        """
        return Samples(self._core.sampled(number("every", every)))

    def at(self, times: ArrayLike) -> Samples:
        """Give the states at any times, s, from 0 to :attr:`end_time`.

        At an event it is the state after it. The columns have the shape of `times`. There is no
        step: a state costs the same anywhere.

        Raises
        ------
        ValueError
            For a time that is not a number or not within the motion.
        """
        array = _numbers("times", times)
        columns = self._core.at(array)
        return Samples({name: column.reshape(array.shape) for name, column in columns.items()})

    def modes(self, times: ArrayLike) -> NDArray[np.str_]:
        """Name what contact and frictions do at these times: "apart", "forward; motor sticks"."""
        array = _numbers("times", times)
        return np.array(self._core.modes_at(array), dtype=np.str_).reshape(array.shape)

    @property
    def events(self) -> NDArray[np.void]:
        """The events as a structured array of time, what, mode_after, states before and after.

        A state is ``load_position_before``, ``load_position_after`` and so on. Ticks of a
        computer's clock are not events. ``energy_lost`` is nan where it is not known.
        """
        return np.array(self._core.events(), dtype=EVENT)

    @property
    def touches(self) -> tuple[MotionTouch, ...]:
        """Moments at which rounding decides whether an event occurs."""
        return self._core.touches()

    @property
    def energy(self) -> EnergyBooks | None:
        """The energy from the start to the end; closed form only."""
        return self._core.energy()

    @property
    def end_time(self) -> float:
        """s"""
        return self._core.end_time

    @property
    def stop(self) -> MotionStop:
        """"reached_end", or why the motion ended early."""
        return self._core.stop

    @property
    def stop_text(self) -> str:
        """Why the motion ended early, in words; empty if it did not."""
        return self._core.stop_text

    @property
    def engine(self) -> Engine:
        """"closed form" or "general"."""
        return self._core.engine

    def __reduce__(self) -> tuple[Any, ...]:
        return _simulated_again, (self.drive, *self._span)

    def __repr__(self) -> str:
        return f"<Motion to {self.end_time:g} s, {len(self._core.events())} events, {self.stop}>"

    _repr_png_ = _notebook.png_of_motion


def simulate(drive: Drive, until: float, *, start: Start | None = None,
             most_events: int = 1_000_000, progress: Progress = None) -> Motion:
    """Simulate the exact motion under the drive's reference and load torque.

    There is no step size: the motion goes from event to event and is exact except for rounding.

    Parameters
    ----------
    drive : Drive
    until : float
        s, ≥ 0.
    start : Start, optional
        Positions rad, speeds rad/s; default at rest at 0.
    most_events : int
        The motion stops after this many, clock ticks included.
    progress : callable, optional
        As of :func:`analyse`.

    Returns
    -------
    Motion

    Raises
    ------
    InvalidInput
        For a faulty drive, end or start.

    Examples
    --------
    >>> import gearlash
    >>> servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
    >>> motion = gearlash.simulate(servo, until=200, start=gearlash.Start(load_position=1.0))
    >>> motion.at([0.0, 200.0]).load_position.round(6).tolist()
    [1.0, 0.227426]
    >>> sorted(set(motion.events["what"].tolist()))
    ['faces part', 'impact backward', 'impact forward']
    """
    end, most = number("until", until), whole("most_events", most_events, 0)
    return Motion(_core.simulate(drive, end, start, most, progress), drive, (end, start, most))


def _simulated_again(drive: Drive, until: float, start: Start | None, most_events: int) -> Motion:
    """A copied motion: computed anew, with the same bits."""
    return simulate(drive, until, start=start, most_events=most_events)


def _numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Real numbers of any layout and real type as contiguous doubles."""
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError(f"{name} must not be a masked array")
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be an array of real numbers, not of {array.dtype}")
    if np.isnan(array).any():
        raise ValueError(f"{name} must be numbers: nan at index {int(np.isnan(array).argmax())}")
    return np.asarray(array, dtype=np.float64, order="C")
