"""Pictures, drawn without a screen: what is drawn is what was computed."""

import numpy as np
import pytest

pyplot = pytest.importorskip("matplotlib.pyplot")

import gearlash  # noqa: E402
from gearlash import plot  # noqa: E402

PNG = b"\x89PNG"


@pytest.fixture(autouse=True)
def closed():
    yield
    pyplot.close("all")


def line_of(ax, label):
    return next(line for line in ax.lines if line.get_label() == label)


def test_a_motion_over_time(servo):
    motion = gearlash.simulate(servo, 20.0, start=gearlash.Start(load_position=0.5))
    ax = plot.motion(motion, unit="deg")
    for shaft in ("load", "motor"):
        times, drawn = line_of(ax, shaft).get_data()
        assert (times[0], times[-1]) == (0.0, pytest.approx(20.0)) and len(times) > 50
        assert drawn == pytest.approx(np.degrees(motion.at(times)[f"{shaft}_position"]), abs=1e-6)
    labels = [axes.get_ylabel() for axes in ax.figure.axes]
    assert labels == ["position (deg)", "gap (deg)", "torque (N m)"]
    assert ax.figure.axes[-1].get_xlabel() == "time (s)"


def test_the_reference_is_drawn_where_there_is_one(pd_drive):
    drive = pd_drive.with_({"reference.kind": "constant", "reference.value": "1 deg"})
    ax = plot.motion(gearlash.simulate(drive, 0.5), unit="deg")
    assert set(line_of(ax, "reference").get_ydata()) == {1.0}


def test_a_cycle_in_the_phase_plane_has_its_amplitude(servo):
    answer = gearlash.analyse(servo)
    ax = plot.cycle(answer)
    for shaft, amplitude in (("motor", answer.cycles[0].motor_amplitude),
                             ("load", answer.cycles[0].amplitude)):
        drawn = line_of(ax, shaft).get_xdata()
        swing = np.nanmax(drawn) - np.nanmin(drawn)
        assert swing / 2 == pytest.approx(amplitude, rel=1e-3)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("position from the reference (rad)",
                                                  "speed (rad/s)")


def test_each_kind_of_layer_is_drawn_in_given_axes():
    def layer(kind, name, points):
        return gearlash.Layer(kind=kind, name=name, points=points, dashes="4,2", mark="open_square",
                              in_legend=kind != "line")

    gap = (float("nan"), float("nan"))
    square = ((0, 0), (1, 0), (1, 1), gap, (2, 2), (3, 2), (3, 3))
    panel = gearlash.Panel(
        x=gearlash.PlotAxis(label="time (s)", low=1.0, high=4.0, tics=[gearlash.Tic(2.0, "two")]),
        y=gearlash.PlotAxis(label="gap", low=0.1, high=10.0, logarithmic=True),
        layers=[layer("area", "apart", square), layer("line", "load", square),
                layer("marks", "impact", square)],
        texts=[gearlash.PlotText(at=gearlash.MapPoint(2.0, 1.0), text="here")])
    ax = plot.draw(gearlash.Plot(columns=((panel,),)), ax=pyplot.subplots()[1])
    assert len(ax.collections[0].get_paths()) == 2
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["apart", "impact"]
    assert (ax.get_xlim(), ax.get_yscale()) == ((1.0, 4.0), "log")
    assert [label.get_text() for label in ax.get_xticklabels()] == ["two"]
    assert ax.texts[0].get_text() == "here"


def test_curves_have_the_numbers_of_a_sweep(servo):
    axes = {"servo.backlash": [0.1, 0.2, 0.3]}
    data = gearlash.sweep(servo, axes, ["amplitude"])
    ax = plot.curves(servo, axes, unit="mrad")
    assert ax.lines[0].get_ydata() == pytest.approx(1e3 * data["amplitude"].values)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("backlash (mrad)", "amplitude (mrad)")


def test_a_map_has_the_border_of_hunting(servo):
    ax = plot.map(servo, {"servo.damping": "0.1:1.2:12", "servo.friction_ratio": "0.05:0.9:9"})
    assert len(line_of(ax, "hunting ends").get_xdata()) > 10
    assert line_of(ax, "now").get_xydata().tolist() == [[0.1, 0.19]]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("friction ratio", "damping")


def test_a_production_run_in_three_pictures(servo):
    varied = {"servo.damping": gearlash.UniformBetween(0.2, 0.4)}
    study = gearlash.tolerance(servo, varied, samples=1024)
    steps = plot.distribution(study, unit="deg").lines[0].get_data()
    assert steps[1][1:-1:2] == pytest.approx(np.array(study.histogram.counts) / 10.24)
    assert steps[0][1:-1:2] == pytest.approx(np.degrees(study.histogram.edges[:-1]))
    assert plot.yield_(study).lines[0].get_ydata()[-1] == pytest.approx(100.0)
    bars = plot.indices(study, gearlash.sensitivity_indices(servo, varied, samples=1024))
    assert [text.get_text() for text in bars.get_yticklabels()] == ["servo.damping"]


def test_a_figure_of_the_thesis():
    names = [text.get_text() for text in plot.figure(7).figure.legends[0].get_texts()]
    assert names[0] == "damping 0.1" and names[-1] == "hunting ends"
    with pytest.raises(ValueError, match="2 to 15"):
        plot.figure(1)


def test_another_cycle_is_never_drawn_in_its_place():
    drive = gearlash.Drive.normal_form(0.01, 0.01, 0.5, 0.3, restitution=1.0)
    answer = gearlash.analyse(drive)
    unstable = [cycle for cycle in answer.cycles if cycle.stability == "unstable"]
    for cycle in unstable:
        with pytest.raises(ValueError, match="not stable"):
            plot.cycle(answer, cycle)


def test_what_cannot_be_drawn_is_said(servo):
    quiet = gearlash.Drive.normal_form(0.9, 2, 0.5, 0.3)
    with pytest.raises(ValueError, match="cannot hunt"):
        plot.cycle(gearlash.analyse(quiet))
    with pytest.raises(gearlash.InvalidInput, match="axes = 0: must be 2"):
        plot.map(servo, {})
    with pytest.raises(gearlash.InvalidInput, match="no sample hunts"):
        plot.distribution(gearlash.tolerance(quiet, {"servo.damping": gearlash.ExactValue(0.9)},
                                             samples=64))
    with pytest.raises(gearlash.InvalidInput, match="furlong"):
        plot.motion(gearlash.simulate(servo, 1.0), unit="furlong")


def test_notebooks_have_pictures_and_keep_no_figure(servo):
    answer = gearlash.analyse(servo)
    before = pyplot.get_fignums()
    assert answer._repr_png_().startswith(PNG)
    assert gearlash.simulate(servo, 2.0)._repr_png_().startswith(PNG)
    assert pyplot.get_fignums() == before
    assert gearlash.analyse(gearlash.Drive.normal_form(0.9, 2, 0.5, 0.3))._repr_png_() is None
    assert answer._repr_html_().startswith("<b>hunts")
