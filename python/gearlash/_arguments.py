"""Arguments of public functions: what is wrong is said with the argument's own name."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import Any, TypeVar

_One = TypeVar("_One")


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
    return list(several)
