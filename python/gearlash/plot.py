"""Pictures by Matplotlib. Each function draws into axes, a new figure's unless given, and returns them.

The style is meant for print: one column of a journal wide, thin lines, colours that the colour-blind
can tell apart, names with units on the axes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import pyplot
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from gearlash._arguments import whole
from gearlash._methods import Answer
from gearlash._motion import Motion, simulate
from gearlash._records import Cycle, Start, ToleranceStudy
from gearlash._sweep import verdict_words

if TYPE_CHECKING:
    import xarray

Axes = Any  # matplotlib.axes.Axes

#: Wong, Nature Methods 8, 441 (2011).
COLOURS = {"load": "#0072B2", "motor": "#D55E00", "reference": "#000000", "hunts": "#D55E00",
           "rest": "#009E73"}
_WIDTH = 3.5  # inches: a column

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


def motion(moving: Motion, *, unit: str = "rad", points: int = 2000, ax: Axes | None = None) -> Axes:
    """Draw both shafts and the reference over time.

    Parameters
    ----------
    moving : Motion
    unit : str
        Of angles: rad, mrad, deg, arcmin or arcsec.
    points : int
        Times, evenly spaced.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = _axes(ax)
    samples = moving.at(np.linspace(0.0, moving.end_time, whole("points", points, 2, 10**8)))
    for name, label in (("motor_position", "motor"), ("load_position", "load")):
        ax.plot(samples.time, samples[name] / _unit(unit), color=COLOURS[label], linewidth=0.9,
                label=label)
    if samples.reference.any():
        ax.plot(samples.time, samples.reference / _unit(unit), color=COLOURS["reference"],
                linewidth=0.7, linestyle="--", label="reference")
    ax.legend(frameon=False)
    return _tidy(ax, "time (s)", f"position ({unit})")


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
    samples = moving.at(np.linspace(settled, moving.end_time, 2000))
    drawn = float(np.ptp(samples.load_position)) / 2
    if abs(drawn - which.amplitude) > 2e-3 * max(which.amplitude, which.motor_amplitude):
        raise ValueError(f"the motion from ±{which.amplitude:.4g} rad leads to ±{drawn:.4g} rad: "
                         "the cycle is not stable, or another one draws the start in")
    ax = _axes(ax)
    for shaft in ("motor", "load"):
        ax.plot(samples[f"{shaft}_position"] / _unit(unit), samples[f"{shaft}_speed"] / _unit(unit),
                color=COLOURS[shaft], linewidth=0.9, label=shaft)
    ax.legend(frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return _tidy(ax, f"position ({unit})", f"speed ({unit}/s)")


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
