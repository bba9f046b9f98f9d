"""What records do beside holding numbers. Each class here is the base of the record of its name."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, ClassVar

from gearlash import _core, _notebook
from gearlash._arguments import listed

if TYPE_CHECKING:
    from gearlash import _records
    from gearlash._drive import Drive


class Record:
    """What all records do."""

    _sequences: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        """Keep sequences as tuples, for a record never changes."""
        for name in self._sequences:
            given = getattr(self, name)
            if not isinstance(given, tuple):
                kept = given.tolist() if hasattr(given, "tolist") else given
                object.__setattr__(self, name, tuple(listed(name, kept)))

    _repr_html_ = _notebook.html_of_record


class Bounds(Record):
    low: float
    high: float

    def __contains__(self, value: float) -> bool:
        return self.low <= value <= self.high


class Ceiling(Record):
    def widest_backlash(self, amplitude: float, backlash: float) -> float | None:
        """Give the largest backlash, rad, that provably keeps the load within `amplitude`, rad.

        Parameters
        ----------
        amplitude : float
            rad, the permitted deviation of the load from the motion without a gap.
        backlash : float
            rad, the drive's own.

        Returns
        -------
        float or None
            None if the other terms exceed the amplitude or there is no ceiling.
        """
        return _core.widest_backlash_of_ceiling(self, amplitude, backlash)


class Answer(Record):
    cycles: tuple[_records.Cycle, ...]
    drive: Drive | None
    verdict: str

    @property
    def hunts(self) -> bool:
        """Whether the drive can move permanently, by itself or if disturbed, or runs away."""
        return _core.hunts(self.verdict)

    @property
    def largest_stable(self) -> _records.Cycle | None:
        """The cycle that is seen in practice, the largest that is not unstable."""
        return _core.largest_stable(self)

    def value(self, quantity: str) -> float | None:
        """Give a quantity in SI; None if it does not exist or is not known.

        Parameters
        ----------
        quantity : str
            One of :func:`gearlash.quantities`: "amplitude", "frequency", "ceiling", …. Amplitudes
            are 0 if the drive comes to rest.
        """
        return _core.value(self, quantity)

    def to_json(self) -> str:
        """Give the output of ``gearlash limit-cycle --format json``."""
        return _core.to_json(self._of_drive(), self)

    def to_dict(self) -> dict[str, Any]:
        """Give :meth:`to_json` as Python's own types."""
        parsed: dict[str, Any] = json.loads(self.to_json())
        return parsed

    @property
    def headline(self) -> str:
        """The answer in one line."""
        return _core.headline(self._of_drive(), self)

    def _of_drive(self) -> Drive:
        if self.drive is None:
            raise ValueError("the answer has no drive; use dataclasses.replace(answer, drive=…)")
        return self.drive

    def __str__(self) -> str:
        return _core.to_text(self.drive, self) if self.drive is not None else repr(self)

    _repr_html_ = _notebook.html_of_answer
    _repr_png_ = _notebook.png_of_answer


class Jacobian(Record):
    quantities: tuple[str, ...]
    paths: tuple[str, ...]
    values: tuple[float | None, ...]
    present: tuple[float, ...]
    slopes: tuple[float | None, ...]

    def slope(self, quantity: str, path: str) -> float | None:
        """Give ∂quantity/∂parameter in SI; None where it does not exist."""
        return _core.slope(self, *self._places(quantity, path))

    def elasticity(self, quantity: str, path: str) -> float | None:
        """Give ∂ln quantity/∂ln parameter: per cent per one per cent; 0 where the parameter is 0."""
        return _core.elasticity(self, *self._places(quantity, path))

    def _places(self, quantity: str, path: str) -> tuple[int, int]:
        for name, known in ((quantity, self.quantities), (path, self.paths)):
            if name not in known:
                raise KeyError(f"{name}; this Jacobian has {', '.join(known)}")
        return self.quantities.index(quantity), self.paths.index(path)


class FeasibleValues(Record):
    def __contains__(self, value: float) -> bool:
        """Whether the value of the parameter meets the target."""
        return _core.permits(self, value)


