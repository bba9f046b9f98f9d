"""Arguments of public functions: what is wrong is said with the argument's own name."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

_One = TypeVar("_One")
_Word = TypeVar("_Word", bound=str)


def number(name: str, value: Any) -> float:
    """A real number; texts and booleans, which Python would convert, are refused."""
    if isinstance(value, (str, bytes, bool)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} must be a number, not {type(value).__name__}")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{name} must be a number that a double can hold, not {value}") from None


def optional_number(name: str, value: Any) -> float | None:
    return None if value is None else number(name, value)


def whole(name: str, value: Any, least: int, most: int = 2**53) -> int:
    """A whole number within a range."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} must be a whole number, not {type(value).__name__}")
    found = operator.index(value)
    if not least <= found <= most:
        raise ValueError(f"{name} must be from {least} to {most}, not {found}")
    return found


def listed(name: str, several: Iterable[_One]) -> list[_One]:
    """A list of what was given; a text, which Python would take letter by letter, is refused."""
    if isinstance(several, (str, bytes)):
        raise TypeError(f"{name} must be a sequence, such as [{several!r}], not a text")
    if not isinstance(several, Iterable):
        raise TypeError(f"{name} must be a sequence, not {type(several).__name__}")
    return list(several)


def text(name: str, given: str) -> str:
    if not isinstance(given, str):
        raise TypeError(f"{name} must be text, not {type(given).__name__}")
    return given


def mapping(name: str, given: Mapping[str, _One]) -> dict[str, _One]:
    """A mapping whose keys are text."""
    if not isinstance(given, Mapping):
        raise TypeError(f"{name} must be a mapping, not {type(given).__name__}")
    for key in given:
        if not isinstance(key, str):
            raise TypeError(f"{name} must have text as keys, not {type(key).__name__}: {key!r}")
    return dict(given)


def share(name: str, value: Any) -> float:
    """A number above 0, at most 1."""
    found = number(name, value)
    if not 0.0 < found <= 1.0:
        raise ValueError(f"{name} must be above 0 and at most 1, not {found:g}")
    return found


def one_of(name: str, given: str, permitted: tuple[_Word, ...]) -> _Word:
    """A word."""
    for word in permitted:
        if word == text(name, given):
            return word
    raise ValueError(f"{name} must be one of {', '.join(permitted)}, not {given}")


def where_given(**options: Any) -> dict[str, Any]:
    """The options that are not None; of the others a record has its own default."""
    return {name: value for name, value in options.items() if value is not None}
