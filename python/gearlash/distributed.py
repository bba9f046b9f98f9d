"""Sweeps and tolerance studies past one machine, by Dask.

A grid is dealt out in pieces of whole lines of its last axis, so that a drive is followed from its
neighbours as :func:`gearlash.sweep` does, and the data are the same to the bit for any number of
workers. Pieces are small and taken as workers become free, for their costs differ hundredfold. A
piece whose worker dies is computed again by another.
"""

from __future__ import annotations

import math
import uuid
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearlash import _core
from gearlash._analysis import Progress
from gearlash._drive import Drive
from gearlash._records import (Axis, SamplePlan, StudyQuestions, TolerancedDrive,
                               ToleranceStudy)
from gearlash._sweep import AxisLike, dataset, grid_of

if TYPE_CHECKING:
    import xarray

#: Drives that a sweep follows from neighbour to neighbour at most, searched afresh at both ends.
RUN = 32

_Piece = tuple[NDArray[np.int8], dict[str, NDArray[np.float64]]]


def _evaluate(drive: Drive, axes: Sequence[Axis], quantities: Sequence[str], proved: bool) -> _Piece:
    """Answer one piece, in a worker."""
    verdicts, columns = _core.evaluate_grid(drive, axes, quantities, proved, None)
    # Copies, for memory of C++ cannot be sent.
    return np.array(verdicts), {name: np.array(column) for name, column in columns.items()}


def pieces(axes: Sequence[Axis], most: int = 4096) -> list[list[Axis]]:
    """Divide a grid into smaller ones, in its order, each of at most about `most` points.

    Each has one value of the leading axes, a part of one axis and all of the axes after it. The last
    axis is divided only if it is the only one, at multiples of :data:`RUN` values: there a sweep on
    one machine begins a new run too.

    Examples
    --------
    >>> import gearlash
    >>> from gearlash.distributed import pieces
    >>> x, y = gearlash.Axis("a", (1.0, 2.0, 3.0)), gearlash.Axis("b", (1.0, 2.0))
    >>> [[one.values for one in piece] for piece in pieces([x, y], most=4)]
    [[(1.0, 2.0), (1.0, 2.0)], [(3.0,), (1.0, 2.0)]]
    """
    if not axes:
        return [[]]
    if len(axes) == 1:
        step = max(1, most // RUN) * RUN
        return [[_part(axes[0], i, i + step)] for i in range(0, len(axes[0].values), step)]
    inner = math.prod(len(one.values) for one in axes[1:])
    if inner > most and len(axes) > 2:
        return [[_part(axes[0], i, i + 1), *piece]
                for i in range(len(axes[0].values)) for piece in pieces(axes[1:], most)]
    step = max(1, most // inner)
    return [[_part(axes[0], i, i + step), *axes[1:]]
            for i in range(0, len(axes[0].values), step)]


def _part(one: Axis, begin: int, end: int) -> Axis:
    return Axis(one.path, one.values[begin:end], one.logarithmic)


def graph(drive: Drive, axes: Mapping[str, AxisLike] | Sequence[Axis], quantities: Sequence[str], *,
          proved: bool = False, most: int = 4096) -> list[Any]:
    """Give the pieces as :func:`dask.delayed` values, in the order of the grid.

    Each gives the verdicts' numbers and the columns of its points. For programs that schedule them
    themselves; :func:`sweep` does it for all others.
    """
    from dask.delayed import delayed

    one = delayed(_evaluate, pure=True)
    varied, grid = grid_of(drive, axes)
    return [one(varied, piece, tuple(quantities), proved)
            for piece in pieces(grid, most)]


def sweep(drive: Drive, axes: Mapping[str, AxisLike] | Sequence[Axis],
          quantities: Sequence[str] = ("amplitude", "frequency"), client: Any = None, *,
          proved: bool = False, most: int | None = None,
          progress: Progress = None) -> xarray.Dataset | Any:
    """Answer for a grid on all workers of a Dask cluster.

    Parameters
    ----------
    drive, axes, quantities, proved
        As of :func:`gearlash.sweep`.
    client : distributed.Client
        Its workers need Gearlash of this version.
    most : int, optional
        Points of a piece at most; default 65,536 of drives in closed form, else one line of the
        last axis, or :data:`RUN` where it is the only one.
    progress : callable, optional
        Called with the share of the pieces that are done. If it returns False the work is cancelled
        and RuntimeError raised.

    Returns
    -------
    xarray.Dataset or Table
        Equal to that of :func:`gearlash.sweep` to the bit.
    """
    varied, grid = grid_of(drive, axes)
    _core.check_grid(varied, grid, quantities)  # before anything is sent
    if most is None:
        is_closed = _core.is_closed_grid(varied, grid)
        line = len(grid[-1].values) if len(grid) > 1 else RUN
        most = 65_536 if is_closed else line
    tasks = pieces(grid, most)
    calls = [(varied, piece, tuple(quantities), proved) for piece in tasks]
    parts: list[_Piece] = _dealt_out(client, _evaluate, calls, progress)
    verdicts = np.concatenate([part[0] for part in parts])
    columns = {name: np.concatenate([part[1][name] for part in parts]) for name in parts[0][1]}
    return dataset(varied, grid, verdicts, columns, proved=proved)


def study(series: TolerancedDrive, sampling: SamplePlan, questions: StudyQuestions, client: Any, *,
          most: int | None = None, progress: Progress = None) -> ToleranceStudy:
    """Study a production run on all workers of a Dask cluster.

    Parameters
    ----------
    series, sampling, questions
        As :func:`gearlash.tolerance` makes them.
    client : distributed.Client
    most : int, optional
        Samples of a piece at most, rounded up to 64s; default a sixty-fourth of all.

    Returns
    -------
    ToleranceStudy
        Equal to that of :func:`gearlash.tolerance` to the bit.
    """
    samples = sampling.points * sampling.replicates
    block = 64  # of which some are followed from their neighbours
    step = -(-(most or samples // 64 or 1) // block) * block
    calls = [(series, sampling, questions, first, min(step, samples - first))
             for first in range(0, samples, step)]
    parts = _dealt_out(client, _answer_samples, calls, progress)
    return _core.study_of(sampling, questions, np.concatenate(parts))


def _answer_samples(series: TolerancedDrive, sampling: SamplePlan, questions: StudyQuestions,
                    first: int, count: int) -> Any:
    """Answer for some samples, in a worker."""
    return np.array(_core.answer_samples(series, sampling, questions, first, count, None))


def _dealt_out(client: Any, work: Callable[..., Any], calls: Sequence[tuple[Any, ...]],
               progress: Progress) -> list[Any]:
    """Give the results of all calls, in their order, taken by workers as they become free.

    A call whose worker dies is made again by another, as often as the cluster's setting
    ``distributed.scheduler.allowed-failures`` permits. Nothing stays behind where one fails.
    """
    if not hasattr(client, "submit"):
        raise TypeError(f"client must be a distributed.Client, not {type(client).__name__}")
    from distributed import as_completed

    run = uuid.uuid4().hex
    futures = [client.submit(work, *call, pure=False, key=f"gearlash-{run}-{number}")
               for number, call in enumerate(calls)]
    numbers = {future.key: number for number, future in enumerate(futures)}
    done: dict[int, Any] = {}
    try:
        for future, result in as_completed(futures, with_results=True):
            done[numbers[future.key]] = result
            future.release()
            goes_on = None if progress is None else progress(len(done) / len(calls))
            if goes_on is not None and not goes_on:
                raise RuntimeError("stopped by progress")
    finally:
        client.cancel([future for future in futures if numbers[future.key] not in done])
    return [done[number] for number in range(len(calls))]
