"""Each kind of picture has the same layers in gnuplot, in Matplotlib and in the page."""

import dataclasses
import json
import os
import re
import shutil
import subprocess

import numpy as np
import pytest

pyplot = pytest.importorskip("matplotlib.pyplot")

import gearlash  # noqa: E402
from conftest import ROOT, TOOL  # noqa: E402
from gearlash import _core, plot  # noqa: E402

NORMAL = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
DRIVES = {
    "plastic": NORMAL,
    "bouncing": NORMAL.with_({"contact.restitution": 0.5}),
    "quiet": NORMAL.with_({"servo.damping": 0.9}),
    "motor": gearlash.Drive.from_toml(ROOT / "examples/elinco-fd162.toml"),
    # As its file gives all numbers again: sensor.speed then stays where sensor.position moves.
    "rubbing": gearlash.Drive.from_toml(
        gearlash.Drive.from_toml(ROOT / "examples/camera-head.toml").to_toml()),
    "searched": gearlash.Drive(
        motor={"kind": "torque-controlled", "inertia": "20 g cm^2", "friction": 1e-5},
        gearbox={"ratio": 20, "backlash": "2 mrad"}, load={"inertia": 5e-3, "friction": 1e-3},
        controller={"kind": "PD", "proportional": 20.0, "derivative": 0.02, "filter": "1 ms"}),
}
#: The tool's words for a picture; an axis is inserted for {x} and {y}.
KINDS = {
    "phase": "limit-cycle --plot phase=", "time": "limit-cycle --plot time=",
    "ceiling": "limit-cycle --plot ceiling=", "tornado": "limit-cycle --plot tornado=",
    "nyquist": "describe --plot nyquist=", "curves": "chart --x {x} --plot curves=",
    "map": "map --y {y} --x {x} --plot map=", "bifurcation": "chart --x {x} --plot bifurcation=",
    "comparison": "compare --plot time=", "distribution": "tolerance --plot distribution=",
    "yield": "tolerance --plot yield=", "indices": "tolerance --plot indices=",
}
WITH_AXES = {"curves": 1, "bifurcation": 1, "map": 2}
OF_A_RUN = ("distribution", "yield", "indices")


@pytest.fixture(autouse=True)
def closed():
    yield
    pyplot.close("all")


def question_of(kind, drive):
    """With axes around the present drive, and a tolerance."""
    def axis(path, count):
        value = drive[path]
        return gearlash.linear(path, 0.8 * value, 1.25 * value, count)

    gap = "servo.backlash" if "servo.backlash" in drive.to_dict() else "gearbox.backlash"
    other = "servo.inertia_ratio" if gap.startswith("servo") else "load.inertia"
    axes = (axis(other, 2), axis(gap, 3))[2 - WITH_AXES.get(kind, 0):]
    about = gearlash.UniformAbout(drive[gap], 0.1 * drive[gap])
    varied = (gearlash.ParameterTolerance(gap, about),)
    return gearlash.PictureQuestion(kind=kind, drive=drive, angle="rad", axes=axes,
                                    varied=varied if kind in OF_A_RUN else ())


@pytest.fixture(scope="module")
def pictures():
    """The plots that there are, by kind and drive."""
    made = {}
    for kind in KINDS:
        for name, drive in DRIVES.items():
            if kind in OF_A_RUN and name == "searched":
                continue  # half a minute
            question = question_of(kind, drive)
            try:
                made[kind, name] = question, _core.picture_of(question, None)
            except gearlash.InvalidInput as error:
                assert "must be left out" in str(error), (kind, name)
    assert {kind for kind, _ in made} == set(KINDS)
    return made


def panels_of(drawn):
    return [panel for column in drawn.columns for panel in column]


def legend_of(drawn):
    return [layer.name for panel in panels_of(drawn) for layer in panel.layers if layer.in_legend]


def points_of(layer):
    """Only those that are finite."""
    points = np.array(layer.points, dtype=float).reshape(-1, 2)
    return points[np.isfinite(points).all(axis=1)]


def test_matplotlib_draws_every_layer(pictures):
    for key, (_, drawn) in pictures.items():
        figure = plot.draw(drawn).figure
        columns = max(len(column) for column in drawn.columns)
        grid = np.array(figure.axes).reshape(columns, len(drawn.columns))
        for i, column in enumerate(drawn.columns):
            for panel, ax in zip(column, grid[:, i]):
                lines, areas = iter(ax.lines), iter(ax.collections)
                for layer in panel.layers:
                    if layer.kind == "area":
                        paths = [path.vertices[:-1] for path in next(areas).get_paths()]
                        found = np.vstack(paths) if paths else np.empty((0, 2))
                    else:
                        found = np.transpose(next(lines).get_data())
                    found = found[np.isfinite(found).all(axis=1)].reshape(-1, 2)
                    assert np.array_equal(found, points_of(layer)), (*key, layer.name)
                assert ax.get_ylabel() == panel.y.label, key
            assert grid[len(column) - 1, i].get_xlabel() == column[-1].x.label, key
        texts = figure.legends[0].get_texts() if figure.legends else []
        assert [text.get_text() for text in texts] == legend_of(drawn), key
        pyplot.close(figure)


def plain(text):
    """Text without gnuplot's markup."""
    return re.sub(r"\\(.)", r"\1", re.sub(r"(?<!\\)_{(\w+)}", r"_\1", text)).replace("''", "'")


def script_of(question, folder):
    """What the tool gives gnuplot, whose place a shell script takes."""
    (folder / "gnuplot").write_text("#!/bin/sh\ncat > script\necho '<?xml version=\"1.0\"?></svg>'\n")
    (folder / "gnuplot").chmod(0o755)
    text = question.drive.to_toml()
    if question.varied:
        text = re.sub(r'\{ value = ("[^"]*"), .* \}', r"\1", text)
        gap = re.search(r'^backlash = "?([^ "\n]+).*', text, re.M)
        text = text.replace(gap[0], f'backlash = "{gap[1]} rad ± 10 %"')
    (folder / "drive.toml").write_text(text)
    texts = [f"{axis.path}={axis.values[0]!r}:{axis.values[-1]!r}:{len(axis.values)}"
             for axis in question.axes]
    axes = dict(zip(("x", "y"), reversed(texts)))
    verb, *words = [word.format(**axes) for word in KINDS[question.kind].split()]
    environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
    subprocess.run([TOOL, verb, "drive.toml", *words[:-1], words[-1] + "drawn.svg"], cwd=folder,
                   env=environment, capture_output=True, check=False)
    return (folder / "script").read_text()


def test_gnuplot_draws_every_layer(pictures, tmp_path):
    for i, (key, (question, drawn)) in enumerate(pictures.items()):
        folder = tmp_path / str(i)
        folder.mkdir()
        script = script_of(question, folder)
        blocks = iter(re.findall(r"^\$layer\S* << EOD\n(.*?)^EOD$", script, re.M | re.S))
        for panel in panels_of(drawn):
            for layer in panel.layers:
                points = points_of(layer)
                if len(points) == 0:
                    continue
                found = np.array(next(blocks).split(), dtype=float).reshape(-1, 2)
                scale = np.abs(points).max(axis=0)
                assert found.shape == points.shape, (*key, layer.name)
                assert np.all(np.abs(found - points) <= 1e-12 * scale), (*key, layer.name)
        assert next(blocks, None) is None, key
        titles = re.findall(r"keyentry .* title '((?:[^']|'')*)'", script)
        assert [plain(title) for title in titles] == legend_of(drawn), key
        found = re.findall(r"^set x?label '((?:[^']|'')*)'", script, re.M)
        labels = {plain(text) for text in found}
        wanted = {panel.y.label for panel in panels_of(drawn)} | {
            column[-1].x.label for column in drawn.columns}
        assert wanted - {""} <= labels, key


@pytest.mark.skipif(not shutil.which("node") or not (ROOT / "web/node_modules/esbuild").exists(),
                    reason="needs what make web installs")
def test_the_page_draws_every_layer(pictures):
    plots = [dataclasses.asdict(drawn) for _, drawn in pictures.values()]
    found = subprocess.run(["node", ROOT / "tests/python/page_layers.mjs", ROOT],
                           input=json.dumps(plots).replace("NaN", "null"), capture_output=True,
                           text=True, check=True).stdout
    for key, missing in zip(pictures, json.loads(found)):
        assert missing == [], key
