"""Many drives at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlash import _core
from gearlash._analysis import Progress
from gearlash._arguments import listed
from gearlash._drive import Drive
from gearlash._motion import _numbers
from gearlash._records import Axis, ParameterInfo

if TYPE_CHECKING:
    import xarray

#: The largest number of drives of one sweep over arrays, which are held in memory.
MOST_DRIVES = 1_000_000_000

AxisLike = Union[Axis, str, ArrayLike, Sequence[str]]


def linear(path: str, start: float, stop: float, count: int) -> Axis:
    """Make an axis of `count` values of a parameter, evenly spaced, both ends exact; in SI.

    Raises
    ------
    InvalidInput
        For ends that are not finite or not in order, and a count below 2 or above 1,000,000.
    """
    return _core.linear(path, start, stop, count)


def logarithmic(path: str, start: float, stop: float, count: int) -> Axis:
    """Make an axis of `count` values, evenly spaced in logarithm; otherwise as :func:`linear`."""
    return _core.logarithmic(path, start, stop, count)


def axis(drive: Drive, path: str, values: AxisLike) -> Axis:
    """Make an axis of a drive from values as :func:`sweep` takes them.

    Parameters
    ----------
    drive : Drive
    path : str
        Of a number or a word of the drive.
    values : Axis, str, array or sequence of str
        An axis; ``"FROM:TO:COUNT[:log]"`` or ``"A,B,C"`` with units; numbers in SI; or words.

    Raises
    ------
    InvalidInput
        For a parameter that the drive does not have, and for values that it must not have.
    """
    if isinstance(values, Axis):
        if values.path != path:
            raise ValueError(f"{path} must have an axis of its own, not one of {values.path}")
        return values
    if isinstance(values, str):
        return _core.read_axis(path, values, drive)
    array = np.atleast_1d(np.asarray(values))
    if array.dtype.kind in "US":
        return _core.read_axis(path, ",".join(str(word) for word in array.tolist()), drive)
    if array.ndim != 1:
        raise ValueError(f"{path} must have one dimension on an axis, not {array.ndim}; "
                         "give arrays that are broadcast as arrays=…")
    return Axis(path=path, values=tuple(_numbers(path, array).tolist()))


@dataclass(frozen=True, eq=False)
class Table(Mapping[str, NDArray[Any]]):
    """The answers of a sweep where xarray is not installed: arrays by the names of quantities.

    Attributes
    ----------
    dims : tuple of str
        The parameters on the axes, in their order; of broadcast arrays ``dim_0``, ``dim_1``, ….
    coords : dict of str to array
        Their values: numbers in SI, or words.
    data : dict of str to array
        ``verdict``, words; and a column for each quantity, nan where it is not known.
    """

    dims: tuple[str, ...]
    coords: dict[str, NDArray[Any]]
    data: dict[str, NDArray[Any]]

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.data[name]

    def __iter__(self) -> Any:
        return iter(self.data)

    def __len__(self) -> int:
        return len(self.data)


def sweep(drive: Drive, axes: Mapping[str, AxisLike] | Sequence[Axis] | None = None,
          quantities: Sequence[str] = ("amplitude", "frequency"), *,
          arrays: Mapping[str, ArrayLike] | None = None, proved: bool = False,
          client: Any = None, progress: Progress = None) -> xarray.Dataset | Table:
    """Answer for many drives on all cores.

    Parameters
    ----------
    drive : Drive
    axes : mapping of path to values, or sequence of Axis
        Every combination of the values is answered; the last axis runs fastest. Values are those of
        :func:`axis`.
    quantities : sequence of str
        Names of :func:`gearlash.quantities`.
    arrays : mapping of path to array
        Instead of axes: arrays of numbers in SI that are broadcast against each other, as NumPy
        does. One drive for each element, none followed from its neighbour.
    proved : bool
        Prove the closed form's verdicts on plastic contact; what stays open is undecided.
    client : distributed.Client, optional
        Deal the pieces of the grid out to its workers; see :mod:`gearlash.distributed`. The data
        are the same for any number of workers.
    progress : callable, optional
        As of :func:`gearlash.analyse`. Drives that are not reached are undecided.

    Returns
    -------
    xarray.Dataset or Table
        A Dataset where xarray is installed. ``verdict`` as an integer with the attributes
        ``flag_values`` and ``flag_meanings``; every quantity as a variable in SI, nan where it is
        not known. Drives that come to rest have amplitude 0.

    Raises
    ------
    InvalidInput
        For axes that the drive does not have and values that are not permitted.
    TypeError, ValueError
        For arrays of another type, with nan, or that cannot be broadcast.

    Examples
    --------
    >>> import gearlash
    >>> servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
    >>> data = gearlash.sweep(servo, {"servo.damping": "0.1:0.4:4"}, ["amplitude"])
    >>> data["amplitude"].values.round(4).tolist()
    [0.3608, 0.2343, 0.1851, 0.1576]
    >>> import numpy as np
    >>> data = gearlash.sweep(servo, arrays={"servo.damping": np.array([0.1, 0.2]),
    ...                                      "servo.inertia_ratio": np.array([[1.0], [2.0]])})
    >>> data["amplitude"].shape
    (2, 2)
    """
    if (axes is None) == (arrays is None):
        raise TypeError("sweep needs axes or arrays, and not both")
    if arrays is not None:
        if proved or client is not None:
            raise TypeError("proved and client need axes")
        return _sweep_arrays(drive, arrays, quantities, progress)
    asked = listed("quantities", quantities)
    grid = [axis(drive, path, values) for path, values in axes.items()
            ] if isinstance(axes, Mapping) else listed("axes", axes or ())
    if client is not None:
        from gearlash import distributed

        return distributed.sweep(drive, grid, asked, client, proved=proved, progress=progress)
    verdicts, columns = _core.evaluate_grid(drive, grid, asked, proved, progress)
    return dataset(drive, grid, verdicts, columns)


def _sweep_arrays(drive: Drive, arrays: Mapping[str, ArrayLike], quantities: Sequence[str],
                  progress: Progress) -> xarray.Dataset | Table:
    shape = np.broadcast_shapes(*(np.shape(values) for values in arrays.values()))
    if math.prod(shape) > MOST_DRIVES:
        raise ValueError(f"arrays must give at most {MOST_DRIVES:,} drives, not {shape}; "
                         "give a grid by axes")
    # Copies: what the caller does to his arrays later must change neither drives nor coordinates.
    given = {path: np.array(_numbers(path, values)) for path, values in arrays.items()}
    flat = [np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)
            for array in given.values()]
    if flat and flat[0].size == 0:
        raise ValueError(f"arrays must have at least one element; they have the shape {shape}")
    verdicts, columns = _core.evaluate_list(drive, list(given), flat,
                                             listed("quantities", quantities), progress)
    dims = tuple(f"dim_{i}" for i in range(len(shape)))
    return _made(drive, dims, {}, shape, verdicts, columns,
                 {path: np.broadcast_to(array, shape) for path, array in given.items()})


def dataset(drive: Drive, axes: Sequence[Axis], verdicts: NDArray[np.uint8],
            columns: Mapping[str, NDArray[np.float64]]) -> xarray.Dataset | Table:
    """Make the result of a sweep from flat columns, in the order of the grid."""
    facts = _facts(drive)
    coords: dict[str, NDArray[Any]] = {}
    for one in axes:
        words = facts[one.path].choices if one.path in facts else ()
        coords[one.path] = (np.array([words[int(value)] for value in one.values])
                            if words else np.array(one.values))
    shape = tuple(len(one.values) for one in axes)
    return _made(drive, tuple(coords), coords, shape, verdicts, columns, {})


def _facts(drive: Drive) -> dict[str, ParameterInfo]:
    """What is known of each parameter, by its path and by its aliases."""
    facts: dict[str, ParameterInfo] = {}
    for info in drive.parameters():
        facts.update({alias: info for alias in info.aliases})
    facts.update({info.path: info for info in drive.parameters()})
    return facts


def _made(drive: Drive, dims: tuple[str, ...], coords: dict[str, NDArray[Any]], shape: tuple[int, ...],
          verdicts: NDArray[np.uint8], columns: Mapping[str, NDArray[np.float64]],
          given: Mapping[str, NDArray[np.float64]]) -> xarray.Dataset | Table:
    words = _core.words()["Verdict"]
    shaped = {name: column.reshape(shape) for name, column in columns.items()}
    codes = verdicts.reshape(shape)
    try:
        import xarray
    except ImportError:
        named = np.array(words)[codes]
        return Table(dims, {**coords, **given}, {**shaped, "verdict": named})
    facts = {info.name: info for info in _core.quantities()}
    flags = {"flag_values": np.arange(len(words), dtype=np.uint8),
             "flag_meanings": " ".join(word.replace(" ", "_") for word in words),
             "long_name": facts["verdict"].meaning}
    variables: dict[str, Any] = {"verdict": (dims, codes, flags)}
    for name, column in shaped.items():
        if name != "verdict":
            variables[name] = (dims, column, {"units": facts[name].unit,
                                              "long_name": facts[name].meaning})
    of_drive = _facts(drive)

    def described(path: str) -> dict[str, str]:
        info = of_drive.get(path)
        if info is None:
            return {}
        return {"units": info.unit or "1", "long_name": info.meaning}

    described_coords = {path: ((path,), array, described(path)) for path, array in coords.items()}
    described_given = {path: (dims, array, described(path)) for path, array in given.items()}
    return xarray.Dataset(variables, coords={**described_coords, **described_given},
                          attrs={"source": f"gearlash {_core.__version__}"})


def verdict_words(data: xarray.Dataset | Table) -> NDArray[np.str_]:
    """Give the verdicts of a sweep as words: "hunts", "cannot hunt", …."""
    verdict = np.asarray(data["verdict"])
    if verdict.dtype.kind != "U":
        verdict = np.array(_core.words()["Verdict"])[verdict]
    return verdict.astype(np.str_)
