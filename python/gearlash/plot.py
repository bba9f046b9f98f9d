"""Pictures by Matplotlib, the same as the tool's and the page's.

Each function gives the axes of its first panel, whose figure has all of them; in given axes it
draws that panel alone. Each takes ``unit=``, of angles: rad, mrad, deg, arcmin or arcsec, and
``ax=``; those that find what they show take ``progress=`` too, as :func:`gearlash.analyse`. The
style is meant for print: columns of a journal wide, thin lines, colours that the colour-blind can
tell apart, names with units on the axes.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import PolyCollection

from gearlash import _core
from gearlash._analysis import Progress
from gearlash._drive import Drive
from gearlash._methods import Answer
from gearlash._motion import Motion, simulate
from gearlash._records import (Axis, Cycle, Layer, Panel, PictureKind, PictureQuestion, Plot,
                               PlotAxis, SensitivityStudy, Start, ToleranceStudy)
from gearlash._sweep import AxisLike, grid_of

Axes = Any  # matplotlib.axes.Axes
AxesLike = Mapping[str, AxisLike] | Sequence[Axis]

_WIDTH = 3.5  # inches: a column
_HEIGHT = 2.6  # of a panel of 480
_POINTS = 0.45  # of a width of 1 in the library's plots
_LINE = 0.135  # of titles and legends
_LETTERS = 58  # in a column

_MARKS = {"plus": "+", "cross": "x", "star": (8, 2, 0), "square": "s", "circle": "o", "disc": "o",
          "triangle": "^", "wedge": "v", "diamond": "D", "pentagon": "p"}


# ---- drawing -------------------------------------------------------------------------------------


def draw(plot: Plot, *, ax: Axes | None = None) -> Axes:
    """Draw a plot as the library makes it.

    Parameters
    ----------
    plot : Plot
    ax : matplotlib.axes.Axes, optional
        For the first panel alone, without the title.

    Returns
    -------
    matplotlib.axes.Axes
        Those of the first panel.
    """
    if ax is not None:
        _draw_panel(plot.columns[0][0], ax, True)
        _explain(ax, [ax], 1, loc="lower center", bbox_to_anchor=(0.5, 1.0))
        return ax
    width = len(plot.columns)
    lines = (plot.title, *plot.subtitles)
    title = "\n".join(textwrap.fill(line, _LETTERS * width) for line in lines if line)
    named = [layer.name for column in plot.columns for panel in column for layer in panel.layers
             if layer.in_legend]
    rows = -(-len(named) // _columns(named, width))
    heights = [panel.height for panel in max(plot.columns, key=len)]
    above = _LINE * (title.count("\n") + 1.4)
    height = sum(heights) / 480.0 * _HEIGHT + 0.5 + above + _LINE * rows
    figure, grid = pyplot.subplots(
        len(heights), width, squeeze=False, layout="constrained", figsize=(_WIDTH * width, height),
        gridspec_kw={"height_ratios": heights})
    figure.suptitle(title + "\n" * (rows + 1), fontsize=8)  # with room for the legend
    for column, panels in enumerate(plot.columns):
        for panel, axes in zip(panels, grid[:, column]):
            _draw_panel(panel, axes, panel is panels[-1])
    _explain(figure, grid.flat, width, loc="upper center",
             bbox_to_anchor=(0.5, 1.0 - above / height))
    return grid[0, 0]


def _columns(named: list[str], width: int) -> int:
    """Of the legend, whose letters are smaller."""
    longest = max((len(name) for name in named), default=0)
    return max(1, min(4, 5 * _LETTERS * width // 4 // (longest + 8)))


def _explain(place: Any, placed: Iterable[Axes], width: int, **where: Any) -> None:
    """Put the legend of these axes into a place."""
    entries = [entry for axes in placed for entry in zip(*axes.get_legend_handles_labels())]
    if entries:
        place.legend(*zip(*entries), frameon=False, fontsize=6.5, borderpad=0.0, labelspacing=0.4,
                     ncols=_columns([name for _, name in entries], width), **where)


def _draw_panel(panel: Panel, ax: Axes, is_last: bool) -> None:
    for layer in panel.layers:
        _add(ax, layer)
    for word in panel.texts:
        ax.text(word.at.x, word.at.y, word.text, color=word.colour, rotation=word.slope,
                size=6.5 * word.size, weight="bold" if word.is_bold else "normal", ha="center",
                va="center")
    _set_axis(ax.xaxis, ax.set_xscale, ax.set_xlim, panel.x, is_last)
    _set_axis(ax.yaxis, ax.set_yscale, ax.set_ylim, panel.y, True)
    ax.set_title(panel.title, fontsize=7)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)


def _add(ax: Axes, layer: Layer) -> None:
    points = np.array(layer.points).reshape(-1, 2)
    style: dict[str, Any] = {"color": layer.colour,
                             "label": layer.name if layer.in_legend else "_nolegend_"}
    if layer.kind == "area":
        gaps = np.flatnonzero(np.isnan(points[:, 0]))
        parts = [part[~np.isnan(part[:, 0])] for part in np.split(points, gaps)]
        ax.add_collection(PolyCollection(parts, linewidth=0.0, **style))
    elif layer.kind == "marks":
        is_open = layer.mark.startswith("open_") or layer.mark == "circle"
        ax.plot(*points.T, linestyle="none", marker=_MARKS[layer.mark.removeprefix("open_")],
                markersize=4.0 * layer.size, fillstyle="none" if is_open else "full", **style)
    else:
        dashes = tuple(float(one) for one in layer.dashes.split(",")) if layer.dashes else None
        ax.plot(*points.T, linewidth=_POINTS * layer.width,
                linestyle=(0, dashes) if dashes else "-", **style)


def _set_axis(axis: Any, set_scale: Any, set_limits: Any, drawn: PlotAxis,
              is_numbered: bool) -> None:
    set_scale("log" if drawn.logarithmic else "linear")
    set_limits(drawn.low, drawn.high)
    axis.set_ticks([tic.at for tic in drawn.tics],
                   [tic.text if is_numbered else "" for tic in drawn.tics])
    axis.set_ticks([], minor=True)
    axis.set_tick_params(labelsize=7)
    axis.set_label_text(drawn.label if is_numbered else "", fontsize=8)


# ---- of motions ----------------------------------------------------------------------------------


def motion(moving: Motion, *, unit: str = "rad", ax: Axes | None = None) -> Axes:
    """Draw a motion over time: both shafts and the reference, the gap, and the torque."""
    return draw(_core.time_plot(moving._core, moving.drive, unit), ax=ax)


def cycle(answer: Answer, which: Cycle | None = None, *, unit: str = "rad",
          ax: Axes | None = None) -> Axes:
    """Draw a limit cycle in the phase plane, load and motor, as its motion leads into it.

    Parameters
    ----------
    answer : Answer
    which : Cycle, optional
        Default the largest that is not unstable.

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
    return draw(_core.phase_plot(moving._core, drive, unit, settled), ax=ax)


def _settling_time(which: Cycle) -> float:
    """Until a disturbance is down to a thousandth, two hundred periods at most."""
    modulus = min(max(abs(which.multiplier), 1e-3), 0.999)
    periods = float(np.ceil(np.log(1e-3) / np.log(modulus)))
    return which.period * min(200.0, periods + 4.0)


# ---- of a drive ----------------------------------------------------------------------------------


def picture(kind: PictureKind, drive: Drive, axes: AxesLike = (), *, unit: str = "rad",
            progress: Progress = None, ax: Axes | None = None, **question: Any) -> Axes:
    """Draw the picture of that kind; further arguments are members of :class:`PictureQuestion`."""
    varied, grid = grid_of(drive, axes)
    asked = PictureQuestion(kind=kind, drive=varied, angle=unit, axes=tuple(grid), **question)
    return draw(_core.picture_of(asked, progress), ax=ax)


def phase(drive: Drive, **options: Any) -> Axes:
    """Draw the limit cycles in the phase plane, and motions that lead to them."""
    return picture("phase", drive, **options)


def time(drive: Drive, **options: Any) -> Axes:
    """Draw the motion that leads to the hunting, or to rest, over time."""
    return picture("time", drive, **options)


def ceiling(drive: Drive, **options: Any) -> Axes:
    """Draw what the proved bound of every motion is made of."""
    return picture("ceiling", drive, **options)


def tornado(drive: Drive, **options: Any) -> Axes:
    """Draw the sensitivities of the amplitude, in per cent for one per cent."""
    return picture("tornado", drive, **options)


def nyquist(drive: Drive, part: str = "", **options: Any) -> Axes:
    """Draw the loop's gain against −1/N of a part: gap, relay, …; default the first in the loop."""
    return picture("nyquist", drive, part=part, **options)


def curves(drive: Drive, axes: AxesLike, quantity: str = "amplitude", **options: Any) -> Axes:
    """Draw a quantity over the last axis, a curve for each value of the one before.

    Axes are those of :func:`gearlash.sweep`.
    """
    return picture("curves", drive, axes, quantity=quantity, **options)


def map(drive: Drive, axes: AxesLike, quantity: str = "amplitude", target: str = "",
        **options: Any) -> Axes:
    """Draw regions and contours over two axes, the first upwards; shade where a target is met."""
    return picture("map", drive, axes, quantity=quantity, target=target, **options)


def bifurcation(drive: Drive, axes: AxesLike, quantity: str = "amplitude", **options: Any) -> Axes:
    """Draw all cycles, stable and unstable, over one axis, with their borders."""
    return picture("bifurcation", drive, axes, quantity=quantity, **options)


def comparison(drive: Drive, axes: AxesLike = (), **options: Any) -> Axes:
    """Draw step responses for the values of an axis; default the places of the sensor."""
    return picture("comparison", drive, axes, **options)


# ---- of a production run, and of 1960 ------------------------------------------------------------


def distribution(study: ToleranceStudy, *, unit: str = "rad", ax: Axes | None = None) -> Axes:
    """Draw the amplitudes of a production run."""
    return draw(_core.tolerance_plot("distribution", study, unit), ax=ax)


def yield_(study: ToleranceStudy, *, unit: str = "rad", ax: Axes | None = None) -> Axes:
    """Draw the share of samples up to an amplitude."""
    return draw(_core.tolerance_plot("yield", study, unit), ax=ax)


def indices(study: ToleranceStudy, decided: SensitivityStudy, *, ax: Axes | None = None) -> Axes:
    """Draw what decides the amplitude: the indices of :func:`gearlash.sensitivity_indices`."""
    return draw(_core.indices_plot(study, decided), ax=ax)


def figure(number: int, *, ax: Axes | None = None) -> Axes:
    """Draw a figure of the thesis, 2 to 15: exact, and by the program of 1960."""
    drawn = _core.figure_plot(number, None)
    if drawn is None:
        raise ValueError(f"number must be that of a figure, 2 to 15, not {number}")
    return draw(drawn, ax=ax)
