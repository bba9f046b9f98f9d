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
ROTATED = re.compile(r'rotate\([^)]*\)"[^>]*>\s*<text>(.*?)</text>', re.S)
SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
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
    x_factor = factor_of(label for _, y, label in LABEL.findall(text) if float(y) > bottom)
    y_factor = factor_of(ROTATED.findall(text))
    x_scale = scale((x, x_factor * value) for x, y, value in ticks
                    if y > bottom and left <= x <= right)
    y_scale = scale((y - 4.88, y_factor * value) for x, y, value in ticks if x < left)
    curves = []
    for group, width in GROUP.findall(text):
        if float(width) >= LIMIT_WIDTH:
            curves += [curve for _, path in PATH.findall(group) for curve in points_of(path)
                       if all(top - 1 <= y <= bottom + 1 for _, y in curve)]
    return {"range": {"x": [x_scale(left), x_scale(right)], "y": [y_scale(bottom), y_scale(top)]},
            "curves": {f"limit {i}": [[x_scale(x), y_scale(y)] for x, y in curve]
                       for i, curve in enumerate(curves)}}


def number_of(label):
    """Of a label at a tick: 0.1, 2·10⁻⁵, or in pictures of 0.2 with the exponent above it."""
    spans = [html.unescape(span).strip().replace("−", "-")
             for span in re.findall(r">([^<]+)<", f">{label}<")]
    if power := re.fullmatch(r"(?:([\d.]+)·)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", "".join(spans)):
        return float(power[1] or 1) * 10.0 ** int(power[2].translate(SUPERSCRIPTS))
    try:
        base, *exponent = [float(span) for span in spans if span]
        return base ** exponent[0] if exponent else base
    except ValueError:
        return None


def factor_of(names):
    """What the numbers of an axis are multiples of, by its name: "backlash (10⁻³ rad)"."""
    for name in names:
        if power := re.search(r"\(10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", name):
            return 10.0 ** int(power[1].translate(SUPERSCRIPTS))
        if prefix := re.search(r"\(([nµmM])(?:rad|N m)", name):
            return {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "M": 1e6}[prefix[1]]
    return 1.0


def scale(ticks):
    """The value at a place, by the first and the last tick. An axis with 0 is linear, others are
    logarithmic."""
    (first, *_), *_, (last, *_) = ordered = sorted(ticks)
    low, high = ordered[0][1], ordered[-1][1]
    if any(value == 0 for _, value in ordered):
        return lambda place: low + (high - low) * (place - first) / (last - first)
    slope = math.log(high / low) / (last - first)
    return lambda place: low * math.exp(slope * (place - first))
