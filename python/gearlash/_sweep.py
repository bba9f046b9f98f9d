"""Many drives at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlash import _core
from gearlash._analysis import Progress, Report
from gearlash._arguments import listed, mapping, optional_number, whole
from gearlash._drive import Drive
from gearlash._motion import _numbers
from gearlash._records import Axis

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
    return _core.linear(path, start, stop, whole("count", count, 0))


def logarithmic(path: str, start: float, stop: float, count: int) -> Axis:
    """Make an axis of `count` values, evenly spaced in logarithm; otherwise as :func:`linear`."""
    return _core.logarithmic(path, start, stop, whole("count", count, 0))


def axis(drive: Drive, path: str, values: AxisLike) -> Axis:
    """Make an axis of a drive from values as :func:`sweep` takes them.

    Parameters
    ----------
    drive : Drive
    path : str
        Of a number or a word of the drive.
    values : Axis, str, array or sequence of str
        An axis; ``"FROM:TO:COUNT[:log]"`` or ``"A,B,C"`` with units; numbers in SI; or words. An
        axis has doubles. That a text had a decimal with more digits, :func:`sweep` and proofs know
        only where the text is given to :func:`sweep` itself.

    Raises
    ------
    InvalidInput
        For a parameter that the drive does not have, and for values that it must not have.
    """
    if isinstance(values, Axis):
        if values.path != path:
            raise ValueError(f"{path} must have an axis of its own, not one of {values.path}")
        return values
    written = _text_of(values)
    if written is not None:
        return _core.read_axis(path, written, drive)
    array = np.atleast_1d(_numbers(path, values))
    if array.ndim != 1:
        raise ValueError(f"{path} must have one dimension on an axis, not {array.ndim}; "
                         "give arrays that are broadcast as arrays=…")
    return Axis(path=_path_of_number(drive, path), values=array)


def _text_of(values: AxisLike) -> str | None:
    """Values that are text, as an option of the tool has them; None for numbers."""
    if isinstance(values, str):
        return values
    words = np.asarray(values) if not isinstance(values, Axis) else np.empty(0)
    return ",".join(map(str, words.ravel().tolist())) if words.dtype.kind in "US" else None


def grid_of(drive: Drive, axes: Mapping[str, AxisLike] | Sequence[Axis]) -> tuple[Drive, list[Axis]]:
    """Give the drive that the axes vary, and the axes.

    The drive's numbers count as rounded where a text has a decimal with more digits than a double.
    """
    if not isinstance(axes, Mapping):
        return drive, listed("axes", axes)
    made = [axis(drive, path, values) for path, values in mapping("axes", axes).items()]
    written = [(path, text) for path, text in
               ((path, _text_of(values)) for path, values in axes.items()) if text is not None]
    return _core.drive_of_axes(drive, written), made


def _path_of_number(drive: Drive, path: str) -> str:
    """The full path of a parameter that is no word."""
    full = _core.path_named(path, drive)
    for info in drive.parameters():
        if info.path == full and info.choices:
            raise TypeError(f"{path} must be one of {', '.join(info.choices)}, not a number")
    return full


@dataclass(frozen=True, eq=False)
class Table(Mapping[str, NDArray[Any]]):
    """The answers of a sweep where xarray is not installed: arrays by the names of quantities.

    Attributes
    ----------
    dims : tuple of str
        The axes, in their order; of broadcast arrays ``dim_0``, ``dim_1``, ….
    coords : dict of str to array
        The values of the parameters: numbers in SI, or words.
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
          client: Any = None, progress: Progress = None) -> xarray.Dataset | Any:
    """Answer for many drives on all cores.

    Parameters
    ----------
    drive : Drive
    axes : mapping of path to values, or sequence of Axis
        Every combination of the values is answered; the last axis runs fastest. Values are those of
        :func:`axis`. A decimal with more digits than a double makes the drive one whose numbers are
        rounded, as in files.
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
        A Dataset where xarray is installed, else a Table. Its names and attributes are those of the
        tool's NetCDF files: a parameter is named ``gearbox_backlash``, or ``damping`` for one of
        the normal form, and has its ``path``; numbers that do not vary are coordinates too. Words
        are text. ``verdict`` is an integer with the attributes ``flag_values`` and
        ``flag_meanings``; every quantity is a variable in SI, nan where it is not known. Drives
        that come to rest have amplitude 0.

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
    varied, grid = grid_of(drive, axes or ())
    if client is not None:
        from gearlash import distributed

        return distributed.sweep(varied, grid, quantities, client, proved=proved, progress=progress)
    verdicts, columns = _core.evaluate_grid(varied, grid, quantities, proved, progress)
    return dataset(varied, grid, verdicts, columns, proved=proved)


def compare(drives: Drive | Mapping[str, Drive],
            axes: Mapping[str, AxisLike] | Sequence[Axis] | None = None,
            quantities: Sequence[str] = (), *, step: float | None = None,
            until: float | None = None, progress: Progress = None) -> Report:
    """Put drives, or the values of one parameter, side by side.

    Parameters
    ----------
    drives : Drive, or mapping of name to Drive
    axes : mapping of path to values, or sequence of Axis, optional
        The values of one parameter of one drive, as :func:`sweep` takes them; default the sensor on
        the load, on the motor and on both (position of the load, speed of the motor).
    quantities : sequence of str
        Names of :func:`gearlash.quantities`; default those that ``gearlash compare`` shows.
    step : float, optional
        rad, of the reference; default that of the first drive: ``specification.step``.
    until : float, optional
        s, the end of the step responses; default twenty periods of each loop, or more where the load
        needs longer to rise.
    progress : callable, optional
        As of :func:`gearlash.analyse`.

    Returns
    -------
    Report
        The JSON of ``gearlash compare`` by its keys, in SI.

    Raises
    ------
    InvalidInput
        For a faulty drive, values that are not permitted, a step of 0 and a time that is not
        positive.

    Examples
    --------
    >>> import gearlash
    >>> servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
    >>> report = gearlash.compare(servo, {"servo.damping": [0.19, 0.9]}, ["amplitude"])
    >>> [one["answer"]["verdict"] for one in report["drives"]]
    ['hunts', 'cannot hunt']
    """
    one = None
    if isinstance(drives, Mapping):
        if axes is not None:
            raise TypeError("axes need one drive")
        named = list(mapping("drives", drives).items())
    else:
        varied, grid = grid_of(drives, {"sensor.position": "load,motor,both"} if axes is None else axes)
        if len(grid) != 1:
            raise ValueError(f"axes must be one, not {len(grid)}")
        named, one = [("", varied)], grid[0]
    return Report(*_core.compare(named, one, quantities,
                                 optional_number("step", step), optional_number("until", until),
                                 progress))


def _sweep_arrays(drive: Drive, arrays: Mapping[str, ArrayLike], quantities: Sequence[str],
                  progress: Progress) -> xarray.Dataset | Any:
    # Copies: what the caller does to his arrays later must change neither drives nor coordinates.
    shapes = {path: np.shape(values) for path, values in mapping("arrays", arrays).items()}
    try:
        shape = np.broadcast_shapes(*shapes.values())
    except ValueError:
        listed_shapes = ", ".join(f"{path} {size}" for path, size in shapes.items())
        raise ValueError("arrays must have shapes that can be broadcast against each other, not "
                         f"{listed_shapes}") from None
    if math.prod(shape) > MOST_DRIVES:
        raise ValueError(f"arrays must give at most {MOST_DRIVES:,} drives, not {shape}; "
                         "give a grid by axes")
    given: dict[str, NDArray[np.float64]] = {}
    for path, values in arrays.items():
        full = _path_of_number(drive, path)
        if full in given:
            raise ValueError(f"arrays must give {full} once, not by two of its names")
        given[full] = np.array(_numbers(path, values))
    flat = [np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)
            for array in given.values()]
    if flat and flat[0].size == 0:
        raise ValueError(f"arrays must have at least one element; they have the shape {shape}")
    verdicts, columns = _core.evaluate_list(drive, list(given), flat, quantities, progress)
    one_of_each = [Axis(path, column[:1]) for path, column in zip(given, flat)]
    about = _core.description(drive, one_of_each, _named(columns), False)
    dims = tuple(f"dim_{i}" for i in range(len(shape)))
    values = [np.broadcast_to(array, shape) for array in given.values()]
    return _made(about, dims, [(dims, array) for array in values], shape, verdicts, columns)


def dataset(drive: Drive, axes: Sequence[Axis], verdicts: NDArray[np.int8],
            columns: Mapping[str, NDArray[np.float64]], *, proved: bool = False
            ) -> xarray.Dataset | Any:
    """Make the result of a sweep from flat columns, in the order of the grid."""
    about = _core.description(drive, axes, _named(columns), proved)
    dims = tuple(about[1])[:len(axes)]
    coords = [((name,), np.array(one.values)) for name, one in zip(dims, axes)]
    shape = tuple(len(one.values) for one in axes)
    return _made(about, dims, coords, shape, verdicts, columns)


def _named(columns: Mapping[str, NDArray[np.float64]]) -> list[str]:
    """The quantities besides the verdict, which all data have."""
    return [name for name in columns if name != "verdict"]


def _made(about: tuple[dict[str, Any], dict[str, _core._Variable]], dims: tuple[str, ...],
          varied: Sequence[tuple[tuple[str, ...], NDArray[Any]]], shape: tuple[int, ...],
          verdicts: NDArray[np.int8], columns: Mapping[str, NDArray[np.float64]]
          ) -> xarray.Dataset | Any:
    """The data as the tool's files describe them. `varied`: dimensions and values of the axes."""
    attributes, described = about
    of_file = ("coordinates", "missing_value")  # which xarray writes by itself
    attrs = {name: {key: value for key, value in of.items() if key not in of_file}
             for name, (_, of, _) in described.items()}
    coords = dict(zip(described, varied))
    for name, (among, values) in coords.items():
        if words := attrs[name].pop("words", "").split():
            coords[name] = (among, np.array(words)[values.astype(int)])
    data: dict[str, NDArray[Any]] = {"verdict": verdicts.reshape(shape)}
    data |= {name: columns[name].reshape(shape) for name in _named(columns)}
    try:
        import xarray
    except ImportError:
        data["verdict"] = np.array(_core.words()["Verdict"])[data["verdict"]]
        return Table(dims, {name: values for name, (_, values) in coords.items()}, data)
    fixed = {name: ((), values[0], attrs[name]) for name, (among, _, values) in described.items()
             if not among}
    return xarray.Dataset({name: (dims, values, attrs[name]) for name, values in data.items()},
                          {**{name: (*of, attrs[name]) for name, of in coords.items()}, **fixed},
                          attributes)


def verdict_words(data: xarray.Dataset | Table) -> NDArray[np.str_]:
    """Give the verdicts of a sweep as words: "hunts", "cannot hunt", …."""
    verdict = np.asarray(data["verdict"])
    if verdict.dtype.kind != "U":
        verdict = np.array(_core.words()["Verdict"])[verdict]
    return verdict.astype(np.str_)
