"""How values look in a notebook."""

from __future__ import annotations

import dataclasses
import html
import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlash._drive import Drive
    from gearlash._methods import Answer
    from gearlash._motion import Motion


def _table(rows: Sequence[tuple[str, ...]], head: tuple[str, ...]) -> str:
    def line(tag: str, cells: tuple[str, ...]) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return "<table>" + line("th", head) + "".join(line("td", row) for row in rows) + "</table>"


def html_of_drive(drive: Drive) -> str:
    """A table of its parameters."""
    facts = {info.path: info for info in drive.parameters()}
    rows = [(path, str(value), facts[path].unit if path in facts else "")
            for path, value in drive.to_dict().items()]
    return _table(rows, ("parameter", "value", "unit"))


def html_of_record(record: Any) -> str:
    """A table of its members; long ones are cut."""
    most = 200
    rows = []
    for member in dataclasses.fields(record):
        text = repr(getattr(record, member.name))
        rows.append((member.name, text if len(text) <= most else text[:most] + " …"))
    return f"<b>{type(record).__name__}</b>" + _table(rows, ("member", "value"))


def html_of_answer(answer: Answer) -> str:
    """The headline, and a table of the cycles."""
    title = html.escape(answer.headline if answer.drive is not None else answer.verdict)
    if not answer.cycles:
        return f"<b>{title}</b>"
    rows = [(cycle.kind, cycle.stability, f"{cycle.amplitude:.4g}", f"{cycle.motor_amplitude:.4g}",
             f"{cycle.period:.4g}", f"{cycle.frequency:.4g}", f"{cycle.multiplier:.4g}")
            for cycle in answer.cycles]
    head = ("cycle", "stability", "amplitude (rad)", "of the motor (rad)", "period (s)",
            "frequency (Hz)", "multiplier")
    return f"<b>{title}</b>" + _table(rows, head)


def _png(axes: Any) -> bytes:
    figure = axes.figure
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=110)
    return buffer.getvalue()


def _figure() -> Any:
    """A figure of its own: pyplot would keep it, and show it a second time."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.0, 3.6), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def png_of_motion(motion: Motion) -> bytes | None:
    """Both shafts over time; None without Matplotlib."""
    try:
        from gearlash import plot

        return _png(plot.motion(motion, ax=_figure().add_subplot()))
    except ImportError:
        return None


def png_of_answer(answer: Answer) -> bytes | None:
    """The limit cycle in the phase plane; None without a cycle or Matplotlib."""
    if answer.drive is None or answer.largest_stable is None:
        return None
    try:
        from gearlash import plot

        return _png(plot.cycle(answer, ax=_figure().add_subplot()))
    except (ImportError, ValueError):
        return None
