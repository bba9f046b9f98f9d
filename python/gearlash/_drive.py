"""Drives: what a file describes, as a value."""

from __future__ import annotations

import json
import math
import os
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsFloat, Union

from gearlash import _core as core
from gearlash import _notebook
from gearlash._arguments import listed, mapping, number, optional_number
from gearlash._errors import InvalidInput

if TYPE_CHECKING:
    from gearlash._records import ParameterInfo, ParameterTolerance

#: What a parameter has: a number in SI, a word, or a list. Typed so that a number needs no cast.
Value = Union[float, Any]
#: What a parameter takes: a number in SI, a text with its unit, a word, a list, a value with its
#: tolerance, or None to take it out.
Given = Union[SupportsFloat, str, Sequence[Any], Mapping[str, Any], None]


def _toml_value(value: Any) -> str:
    """A value of Python as TOML."""
    if hasattr(value, "tolist"):  # a number or an array of NumPy
        value = value.tolist()
    if isinstance(value, Mapping):  # a value with its tolerance
        return "{" + ", ".join(f"{key} = {_toml_value(one)}" for key, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml_value(one) for one in value) + "]"
    if isinstance(value, (bool, int, float)):
        return json.dumps(value) if math.isfinite(value) else _toml_value(str(value))
    return _toml_text(str(value))


def _toml_text(text: str) -> str:
    """Text as TOML, whose escapes are those of JSON; only DEL must be one as well."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _toml(sections: Mapping[str, Mapping[str, Any]]) -> str:
    lines = []
    for name, keys in sections.items():
        if not isinstance(keys, Mapping):
            raise TypeError(f"{name} must be a mapping of keys to values, not {type(keys).__name__}")
        lines.append(f"[{_toml_text(str(name))}]")
        lines += [f"{_toml_text(str(key))} = {_toml_value(value)}" for key, value in keys.items()]
    return "\n".join(lines)


def _setting(value: Any) -> str:
    """A value as `--set` takes it."""
    return value if isinstance(value, str) else _toml_value(value).strip('"')


class Drive:
    """A geared drive, each number at its own shaft.

    A drive never changes; :meth:`with_` gives another one. Drives compare equal if all their
    numbers are the same, and can be pickled. Text about a drive has the unit in which its backlash
    was given; that changes no number and no comparison.

    Parameters
    ----------
    **sections : mapping of str to float, str or list
        The sections of a drive's file: ``motor``, ``gearbox``, ``load``, ``controller``,
        ``contact``, ``sensor``, ``sampling``, ``reference``, ``load_torque``, or ``servo`` for the
        normal form. A number is in SI, a text has its unit: ``"30 arcmin"``. What varies in
        production has its tolerance: ``"2 mrad ± 10 %"`` or ``{"min": 0.001, "max": 0.003}``. The
        reference page of the keys lists them all.

    Raises
    ------
    InvalidInput
        With every fault: unknown sections and keys, missing ones, values that are not permitted.

    Examples
    --------
    >>> import gearlash
    >>> joint = gearlash.Drive(
    ...     motor={"kind": "torque-controlled", "inertia": "20 g cm^2", "friction": 1e-5},
    ...     gearbox={"ratio": 20, "backlash": "2 mrad"},
    ...     load={"inertia": 5e-3, "friction": 1e-3},
    ...     controller={"kind": "PD", "proportional": 20.0, "derivative": 0.02, "filter": "1 ms"},
    ... )
    >>> joint["gearbox.backlash"]
    0.002
    >>> joint.gearbox.ratio
    20.0
    """

    __slots__ = ("_core",)

    _core: core.Drive

    def __init__(self, **sections: Mapping[str, Any]) -> None:
        object.__setattr__(self, "_core", _read(_toml(sections), []))

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a drive never changes: {name} cannot be deleted")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a drive never changes: use drive.with_({{...}}) instead of {name} =")

    @classmethod
    def _of(cls, made: core.Drive) -> Drive:
        drive = cls.__new__(cls)
        object.__setattr__(drive, "_core", made)
        return drive

    @classmethod
    def _empty(cls) -> Drive:
        """The drive of Drive{} in C++, the default of a record's member. It is not sound."""
        return cls._of(core.Drive())

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str]) -> Drive:
        """Read a drive from a TOML file, or from TOML text.

        Parameters
        ----------
        source : str or path
            A path; or the text itself, which has a line break. Signal tables that a file names
            stand beside it. As in every file, a number that has a unit is written with it.

        Raises
        ------
        InvalidInput
            With every fault and its place, ``file:line:column``.
        OSError
            If the file cannot be opened.

        Examples
        --------
        >>> import gearlash
        >>> text = '''
        ... [servo]
        ... damping = 0.19
        ... inertia_ratio = 2
        ... friction_ratio = "1/10"
        ... backlash = 0.3
        ... '''
        >>> gearlash.Drive.from_toml(text)
        Drive.normal_form(damping=0.19, inertia_ratio=2.0, friction_ratio=0.1, backlash=0.3)
        """
        if isinstance(source, str) and "\n" in source:
            text, name, folder = source.encode(), "text", ""
        else:
            path = Path(source)
            text, name, folder = path.read_bytes(), str(path), str(path.parent)
        return cls._of(core.read(text, name, folder, [], False, "rad"))

    @classmethod
    def normal_form(cls, damping: float, inertia_ratio: float, friction_ratio: float,
                    backlash: float = 1.0, restitution: float = 0.0,
                    natural_frequency: float | None = None) -> Drive:
        """Make a servo from the numbers that decide whether it hunts.

        Proportional control of the load's position, with ω_n = 1 rad/s unless given, and
        J_M + J_L = 1 kg m².

        Parameters
        ----------
        damping : float
            ζ = (F_M + F_L)/(2 ω_n (J_M + J_L)); 0 or 1e-15 … 1000.
        inertia_ratio : float
            J_L/J_M; 0, 1e-9 … 1e9 or infinity.
        friction_ratio : float
            F_L/(F_M + F_L), 0 … 1.
        backlash : float
            Face to face at the load's shaft, rad; 0 or 1e-15 … 1e6.
        restitution : float
            0 (plastic) … 1 (elastic).
        natural_frequency : float, optional
            ω_n, rad/s, > 0.

        Raises
        ------
        InvalidInput
            For numbers outside these ranges.

        Examples
        --------
        >>> import gearlash
        >>> servo = gearlash.Drive.normal_form(damping=0.19, inertia_ratio=2, friction_ratio=0.1,
        ...                                    backlash=0.3)
        >>> gearlash.analyse(servo).verdict
        'hunts'
        """
        return cls._of(core.normal_form(
            number("damping", damping), number("inertia_ratio", inertia_ratio),
            number("friction_ratio", friction_ratio), number("backlash", backlash),
            number("restitution", restitution),
            optional_number("natural_frequency", natural_frequency)))

    def with_(self, changes: Mapping[str, Given]) -> Drive:
        """Give the drive with other values of some parameters.

        Parameters
        ----------
        changes : mapping of path to value
            A number in SI, a text with its unit, a word, a list, or None to take a key or a
            section out. Aliases are permitted: ``controller.kp``. A parameter that is given without
            a tolerance has none from then on.

        Raises
        ------
        InvalidInput
            For a parameter that the drive does not have, and for values that are not permitted.

        Examples
        --------
        >>> import gearlash
        >>> servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
        >>> servo.with_({"servo.backlash": "12 arcmin"})["servo.backlash"]
        0.0034906585039886587
        """
        given = mapping("changes", changes)
        numbers = [(path, number(path, value)) for path, value in given.items()
                   if isinstance(value, SupportsFloat) and not isinstance(value, bool)
                   and getattr(value, "ndim", 0) == 0]
        if len(numbers) == len(given):
            return self._of(self._core.with_numbers(numbers))
        settings = [(path, "none" if value is None else _setting(value))
                    for path, value in given.items()]
        return self._of(_read(self._core.given_toml(), settings, self._core.angle_unit))

    @property
    def tolerances(self) -> tuple[ParameterTolerance, ...]:
        """What varies from unit to unit; see :func:`gearlash.tolerance`."""
        return self._core.tolerances

    def with_tolerances(self, tolerances: Iterable[ParameterTolerance]) -> Drive:
        """Give the drive with these tolerances instead of its own.

        A drive has one nominal value: of a distribution about a value, or of lots, it is that of
        the distribution.

        Raises
        ------
        InvalidInput
            For parameters that are no numbers of the drive, and for values they must not have.
        """
        return self._of(self._core.with_tolerances(listed("tolerances", tolerances)))

    @property
    def is_normal_form(self) -> bool:
        """Whether it is given by the numbers of the normal form."""
        return self._core.is_normal_form

    def parameters(self) -> tuple[ParameterInfo, ...]:
        """Give the parameters that this drive has, in the order of files."""
        return self._core.parameters()

    def sections(self) -> dict[str, dict[str, Any]]:
        """Give what the constructor takes: sections of keys, with units.

        All defaults are there, but for a parameter that has the value of another one.
        """
        return tomllib.loads(self._core.given_toml())

    def _written(self) -> dict[str, dict[str, Any]]:
        return tomllib.loads(self.to_toml())

    def to_dict(self) -> dict[str, Value]:
        """Give every parameter by its path: numbers in SI, words and lists."""
        return {f"{name}.{key}": self[f"{name}.{key}"]
                for name, keys in self._written().items() for key in keys}

    def to_toml(self) -> str:
        """Give the file of the drive with all defaults, in SI. Numbers read back exactly."""
        return self._core.to_toml()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write :meth:`to_toml` to a file, which appears whole or not at all.

        Raises
        ------
        OSError
            If it cannot be written.
        """
        try:
            core.save(os.fspath(path), self.to_toml())
        except RuntimeError as error:
            raise OSError(str(error)) from None

    def __contains__(self, path: object) -> bool:
        """Whether the drive has this parameter, by its path."""
        return any(path == info.path or path in info.aliases for info in self.parameters())

    def __iter__(self) -> Iterator[str]:
        """The paths of the parameters that this drive has."""
        return (info.path for info in self.parameters())

    def __getitem__(self, path: str) -> Value:
        """Give a parameter by its path: a number in SI, a word or a list."""
        if not isinstance(path, str):
            raise TypeError(f"path must be text, not {type(path).__name__}")
        section, _, key = path.partition(".")
        written = self._written().get(section, {}).get(key)
        if isinstance(written, list):
            return written
        if isinstance(written, str) and _kind(self, path) in ("choice", "file"):
            return written
        return self._core.get(path)

    def __getattr__(self, name: str) -> Section:
        if not name.startswith("_") and name in self.sections():
            return Section(self, name)
        raise AttributeError(f"a drive has no {name}; this one has the sections "
                             + ", ".join(self.sections()) if not name.startswith("_") else name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.sections()]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Drive) and self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._core.given_toml(), self._core.angle_unit)

    def __repr__(self) -> str:
        sections = self.sections()
        servo = sections.pop("servo", None)
        if servo is None:
            given = ",\n      ".join(f"{name}={keys!r}" for name, keys in sections.items())
            return f"Drive({given})"
        sections.pop("sensor")
        rest = {name: keys for name, keys in sections.items() if name != "contact"}
        contact = sections["contact"]
        if rest or contact["kind"] != "rigid" or self.tolerances:
            return f"Drive(servo={servo!r}, " + ", ".join(
                f"{name}={keys!r}" for name, keys in sections.items()) + ")"
        names = ["damping", "inertia_ratio", "friction_ratio", "backlash"]
        names += ["natural_frequency"] if "natural_frequency" in servo else []
        numbers = [f"{name}={_literal(self[f'servo.{name}'])}" for name in names]
        if contact["restitution"]:
            numbers.append(f"restitution={float(contact['restitution'])!r}")
        return f"Drive.normal_form({', '.join(numbers)})"

    _repr_html_ = _notebook.html_of_drive


class Section(Mapping[str, Value]):
    """One section of a drive: ``drive.motor.inertia`` or ``drive.motor["inertia"]``, in SI."""

    def __init__(self, drive: Drive, name: str) -> None:
        self._drive = drive
        self._name = name

    def __getitem__(self, key: str) -> Value:
        if key not in self._drive._written()[self._name]:
            raise KeyError(key)
        return self._drive[f"{self._name}.{key}"]

    def __getattr__(self, key: str) -> Value:
        if key.startswith("_"):  # of a copy whose members are not there yet
            raise AttributeError(key)
        try:
            return self[key]
        except KeyError:
            raise AttributeError(f"{self._name} has no {key}; it has {', '.join(self)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._drive._written()[self._name])

    def __len__(self) -> int:
        return len(self._drive._written()[self._name])

    def __repr__(self) -> str:
        return repr(dict(self))


def _literal(value: Value) -> str:
    """A number as Python reads it back, also where it is infinite."""
    return f"float({str(value)!r})" if value in (math.inf, -math.inf) else repr(value)


def _kind(drive: Drive, path: str) -> str:
    return next((info.kind for info in drive.parameters() if info.path == path), "number")


def _read(text: str, settings: list[tuple[str, str]], angle_unit: str = "rad") -> core.Drive:
    """Read text that a program made: places in it mean nothing to the caller."""
    try:
        return core.read(text, "", "", settings, True, angle_unit)
    except InvalidInput as error:
        raise InvalidInput(tuple(replace(fault, where="") for fault in error.faults)) from None


def _unpickled(text: str, angle_unit: str) -> Drive:
    return Drive._of(core.read(text, "", "", [], True, angle_unit))
