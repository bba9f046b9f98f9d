"""Pictures by Matplotlib. Each function draws into axes, a new figure's unless given, and returns them.

The style is meant for print: one column of a journal wide, thin lines, colours that the colour-blind
can tell apart, names with units on the axes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import PolyCollection
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from gearlash import _core
from gearlash._arguments import whole
from gearlash._methods import Answer
from gearlash._motion import Motion, simulate
from gearlash._records import Cycle, Layer, Panel, PlotAxis, Start, ToleranceStudy
from gearlash._sweep import verdict_words

if TYPE_CHECKING:
    import xarray

Axes = Any  # matplotlib.axes.Axes

#: Wong, Nature Methods 8, 441 (2011).
COLOURS = {"load": "#0072B2", "motor": "#D55E00", "reference": "#000000", "hunts": "#D55E00",
           "rest": "#009E73"}
_WIDTH = 3.5  # inches: a column
_POINTS = 0.45  # of a width of 1 in the library's plots

_MARKS = {"plus": "+", "cross": "x", "star": (8, 2, 0), "square": "s", "circle": "o", "disc": "o",
          "triangle": "^", "wedge": "v", "diamond": "D", "pentagon": "p"}
_ANGLE = {"rad": 1.0, "mrad": 1e-3, "deg": np.pi / 180, "arcmin": np.pi / 10800,
          "arcsec": np.pi / 648000}


def _axes(ax: Axes | None, height: float = 2.6) -> Axes:
    if ax is not None:
        return ax
    return pyplot.subplots(figsize=(_WIDTH, height), layout="constrained")[1]


def _tidy(ax: Axes, x: str, y: str) -> Axes:
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    return ax


def _unit(angle: str) -> float:
    if angle not in _ANGLE:
        raise ValueError(f"unit must be one of {', '.join(_ANGLE)}, not {angle}")
    return float(_ANGLE[angle])


def draw(panel: Panel, *, ax: Axes | None = None) -> Axes:
    """Draw a panel of a plot as the library makes it.

    Parameters
    ----------
    panel : Panel
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = _axes(ax)
    named: set[str] = set()
    for layer in panel.layers:
        _add(ax, layer, "" if layer.name in named else layer.name)
        named.add(layer.name)
    for word in panel.texts:
        ax.text(word.at.x, word.at.y, word.text, color=word.colour, rotation=word.slope,
                size=7.0 * word.size, ha="center", va="center")
    _set_axis(ax.xaxis, ax.set_xscale, ax.set_xlim, panel.x)
    _set_axis(ax.yaxis, ax.set_yscale, ax.set_ylim, panel.y)
    ax.legend(frameon=False, fontsize="x-small", loc="lower center", bbox_to_anchor=(0.5, 1.0),
              ncols=3)
    return _tidy(ax, panel.x.name, panel.y.name)


def _add(ax: Axes, layer: Layer, label: str) -> None:
    points = np.array(layer.points).reshape(-1, 2)
    style: dict[str, Any] = {"color": layer.colour, "label": label or "_nolegend_"}
    if layer.kind == "area":
        gaps = np.flatnonzero(np.isnan(points[:, 0]))
        parts = [part[~np.isnan(part[:, 0])] for part in np.split(points, gaps)]
        ax.add_collection(PolyCollection(parts, linewidth=0.0, **style))
    elif layer.kind == "marks":
        is_open = layer.mark.startswith("open_") or layer.mark == "circle"
        ax.plot(*points.T, linestyle="none", marker=_MARKS[layer.mark.removeprefix("open_")],
                markersize=5.0 * layer.size, fillstyle="none" if is_open else "full", **style)
    else:
        dashes = tuple(map(float, layer.dashes.split(","))) if layer.dashes else None
        ax.plot(*points.T, linewidth=_POINTS * layer.width,
                linestyle=(0, dashes) if dashes else "-", **style)


def _set_axis(axis: Any, set_scale: Any, set_limits: Any, drawn: PlotAxis) -> None:
    set_scale("log" if drawn.logarithmic else "linear")
    set_limits(drawn.low, drawn.high)
    axis.set_ticks([tic.at for tic in drawn.tics], [tic.text for tic in drawn.tics])
    axis.set_ticks([], minor=True)


def motion(moving: Motion, *, unit: str = "rad", points: int = 2000, ax: Axes | None = None) -> Axes:
    """Draw both shafts and the reference over time, and the gap around the load.

    Parameters
    ----------
    moving : Motion
    unit : str
        Of angles: rad, mrad, deg, arcmin or arcsec.
    points : int
        Without effect: points lie where the curves bend.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes
    """
    _unit(unit)
    whole("points", points, 2, 10**8)
    return draw(_core.plot_over_time(moving._core, moving.drive, unit).columns[0][0], ax=ax)


def cycle(answer: Answer, which: Cycle | None = None, *, unit: str = "rad",
          ax: Axes | None = None) -> Axes:
    """Draw a limit cycle in the phase plane, load and motor, as its motion leads into it.

    Parameters
    ----------
    answer : Answer
    which : Cycle, optional
        Default the largest that is not unstable.
    unit : str
        Of angles.
    ax : matplotlib.axes.Axes, optional

    Raises
    ------
    ValueError
        For an answer without a cycle, and a cycle that the motion does not lead to.
    """
    if not isinstance(answer, Answer):
        raise TypeError(f"answer must be a gearlash.Answer, not {type(answer).__name__}")
    which = which or answer.largest_stable
    if which is None or answer.drive is None:
        raise ValueError(f"the answer has no cycle to draw: {answer.verdict}")
    drive = answer.drive.with_({"reference": None, "load_torque": None})
    begin = Start(load_position=max(which.amplitude, which.motor_amplitude))
    settled = _settling_time(which)
    moving = simulate(drive, settled + which.period, start=begin)
    drawn = float(np.ptp(moving.at(np.linspace(settled, moving.end_time, 2000)).load_position)) / 2
    if abs(drawn - which.amplitude) > 2e-3 * max(which.amplitude, which.motor_amplitude):
        raise ValueError(f"the motion from ±{which.amplitude:.4g} rad leads to ±{drawn:.4g} rad: "
                         "the cycle is not stable, or another one draws the start in")
    _unit(unit)
    return draw(_core.plot_of_cycle(moving._core, drive, unit, settled).columns[0][0], ax=ax)


def _settling_time(which: Cycle) -> float:
    """Until a disturbance is down to a thousandth, two hundred periods at most."""
    modulus = min(max(abs(which.multiplier), 1e-3), 0.999)
    periods = float(np.ceil(np.log(1e-3) / np.log(modulus)))
    return which.period * min(200.0, periods + 4.0)


def sweep(data: xarray.Dataset, quantity: str = "amplitude", *, unit: str | None = None,
          logarithmic: bool = False, ax: Axes | None = None) -> Axes:
    """Draw a quantity of a sweep: a curve over one axis, or a map over two.

    Parameters
    ----------
    data : xarray.Dataset
        Of :func:`gearlash.sweep` with one or two axes.
    quantity : str
    unit : str, optional
        Of angles; default rad.
    logarithmic : bool
        Draw the axes of parameters by ratio.
    ax : matplotlib.axes.Axes, optional

    Raises
    ------
    ValueError
        For another number of axes, and a quantity that the sweep does not have.
    """
    if quantity not in data or quantity == "verdict":
        has = ", ".join(str(name) for name in data if name != "verdict")
        raise ValueError(f"quantity must be one of the sweep's, {has}, not {quantity}")
    values = np.asarray(data[quantity], dtype=float)
    label = str(data[quantity].attrs.get("units", ""))
    if unit is not None and label == "rad":
        values, label = values / _unit(unit), unit
    dims = [str(name) for name in data[quantity].dims]
    names = [_name_of(data, dim) for dim in dims]
    name = f"{quantity.replace('_', ' ')} ({label})"
    ax = _axes(ax)
    if len(dims) == 1:
        ax.plot(data[dims[0]], values, color=COLOURS["load"], linewidth=0.9)
        _tidy(ax, names[0], name)
    elif len(dims) == 2:
        x, y = np.asarray(data[dims[1]]), np.asarray(data[dims[0]])
        mesh = ax.pcolormesh(x, y, values, shading="nearest", cmap="cividis", rasterized=True)
        ax.figure.colorbar(mesh, ax=ax, label=name)
        hunts = np.char.startswith(verdict_words(data), "hunts").astype(float)
        if 0.0 < hunts.mean() < 1.0:
            ax.contour(x, y, hunts, levels=[0.5], colors=[COLOURS["hunts"]], linewidths=1.0)
        _tidy(ax, names[1], names[0])
    else:
        raise ValueError(f"a sweep of one or two axes can be drawn, not of {len(dims)}")
    if logarithmic:
        for axis in (ax.xaxis, ax.yaxis)[:len(dims)]:
            _by_ratio(ax, axis)
    return ax


def _by_ratio(ax: Axes, axis: Any) -> None:
    """A logarithmic axis with plain numbers, also at 2 and 5 where it spans less than two decades."""
    (ax.set_xscale if axis is ax.xaxis else ax.set_yscale)("log")
    low, high = sorted(axis.get_view_interval())
    axis.set_major_formatter(FuncFormatter(_plain))
    axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
    axis.set_minor_formatter(FuncFormatter(_plain) if high < 100.0 * low else NullFormatter())


def _plain(value: float, _: Any) -> str:
    return f"{value:g}"


def _name_of(data: xarray.Dataset, dimension: str) -> str:
    """The parameter with its unit: "gearbox.backlash (rad)"."""
    about = data[dimension].attrs
    path, unit = str(about.get("path", dimension)), str(about.get("units", "1"))
    return path if unit == "1" else f"{path} ({unit})"


def distribution(study: ToleranceStudy, *, unit: str = "rad", ax: Axes | None = None) -> Axes:
    """Draw the histogram of amplitudes of a production run.

    Raises
    ------
    ValueError
        Where no sample hunts.
    """
    histogram = study.histogram
    if not histogram.counts:
        raise ValueError("no sample hunts: there is no histogram of amplitudes")
    ax = _axes(ax)
    ax.stairs(histogram.counts, np.array(histogram.edges) / _unit(unit), fill=True,
              color=COLOURS["load"], label="hunting")
    ax.set_title(f"{study.hunting.value:.1%} hunt", fontsize="medium")
    return _tidy(ax, f"amplitude ({unit})", "samples")
