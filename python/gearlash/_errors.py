"""The exception for bad input."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlash import _core

if TYPE_CHECKING:
    from gearlash._records import Fault


class InvalidInput(ValueError):
    """Bad input, with every fault found.

    Attributes
    ----------
    faults : tuple[Fault, ...]
        Each with the path, the value found, what is permitted and, for a file, where.

    Examples
    --------
    >>> import gearlash
    >>> try:
    ...     gearlash.Drive.normal_form(damping=-1, inertia_ratio=2, friction_ratio=3)
    ... except gearlash.InvalidInput as error:
    ...     for fault in error.faults:
    ...         print(fault.path, fault.value, fault.permitted)
    servo.damping -1 must be 0 or from 1e-15 to 1000
    servo.friction_ratio 3 must be from 0 to 1
    """

    faults: tuple[Fault, ...]

    def __init__(self, faults: tuple[Fault, ...]) -> None:
        super().__init__("\n".join(_core.fault_text(fault) for fault in faults))
        self.faults = tuple(faults)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.faults,)

