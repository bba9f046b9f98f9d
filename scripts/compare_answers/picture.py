"""What a picture of gnuplot shows of a region: its axes and the curves of its limit, in their
units.

A later version may give them as numbers. The picture's size, colours and other layers do not count.
"""
import html
import math
import re

PATH = re.compile(r"<path stroke='([^']*)'\s+d='([^']*)'", re.S)
LABEL = re.compile(r'<g transform="translate\(([-\d.]+),([-\d.]+)\)"[^>]*>\s*<text>(.*?)</text>',
                   re.S)
GROUP = re.compile(r'(<g [^>]*stroke-width="([\d.]+)".*?(?=<g [^>]*stroke-width|$))', re.S)
LIMIT_WIDTH = 3.0  # no other line is as wide


def points_of(path):
    """The polylines of a path: M begins one, L continues it."""
    curves = []
    for command, x, y in re.findall(r"([ML])\s*([-\d.]+),([-\d.]+)", path):
        if command == "M":
            curves.append([])
        curves[-1].append((float(x), float(y)))
    return curves


def limits(text):
    frame = next(curves[0] for _, path in PATH.findall(text)
                 if len((curves := points_of(path))) == 1 and len(curves[0]) == 5)
    (left, right), (top, bottom) = ((min(side), max(side)) for side in zip(*frame))
    ticks = [(float(x), float(y), float(value)) for x, y, label in LABEL.findall(text)
             if (value := number_of(label)) is not None]
    x_scale = scale((x, value) for x, y, value in ticks if y > bottom and left <= x <= right)
    y_scale = scale((y - 4.88, value) for x, y, value in ticks if x < left)
    curves = []
    for group, width in GROUP.findall(text):
        if float(width) >= LIMIT_WIDTH:
            curves += [curve for _, path in PATH.findall(group) for curve in points_of(path)
                       if all(top - 1 <= y <= bottom + 1 for _, y in curve)]
    return {"range": {"x": [x_scale(left), x_scale(right)], "y": [y_scale(bottom), y_scale(top)]},
            "curves": {f"limit {i}": [[x_scale(x), y_scale(y)] for x, y in curve]
                       for i, curve in enumerate(curves)}}


def number_of(label):
    """Of a label at a tick: 0.1, or 10 with an exponent above it."""
    spans = [html.unescape(span).strip().replace("−", "-")
             for span in re.findall(r">([^<]+)<", f">{label}<")]
    try:
        base, *exponent = [float(span) for span in spans if span]
        return base ** exponent[0] if exponent else base
    except ValueError:
        return None


def scale(ticks):
    """The value at a place, by the first and the last tick. An axis with 0 is linear, others are
    logarithmic."""
    (first, *_), *_, (last, *_) = ordered = sorted(ticks)
    low, high = ordered[0][1], ordered[-1][1]
    if any(value == 0 for _, value in ordered):
        return lambda place: low + (high - low) * (place - first) / (last - first)
    slope = math.log(high / low) / (last - first)
    return lambda place: low * math.exp(slope * (place - first))
