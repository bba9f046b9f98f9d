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
    ax = plot.motion(motion, unit="deg", points=500)
    for shaft in ("load", "motor"):
        times, drawn = line_of(ax, shaft).get_data()
        assert (times[0], times[-1]) == (0.0, pytest.approx(20.0)) and len(times) > 50
        assert drawn == pytest.approx(np.degrees(motion.at(times)[f"{shaft}_position"]), abs=1e-6)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time (s)", "position (deg)")
    legend = [text.get_text() for text in ax.get_legend().get_texts()]
    assert {"motor", "load"} < set(legend) and len(legend) == len(set(legend))


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


def test_each_kind_of_layer_is_drawn_with_its_name_once():
    def layer(kind, name, points):
        return gearlash.Layer(kind=kind, name=name, points=points, dashes="4,2", mark="open_square")

    gap = (float("nan"), float("nan"))
    square = ((0, 0), (1, 0), (1, 1), gap, (2, 2), (3, 2), (3, 3))
    panel = gearlash.Panel(
        x=gearlash.PlotAxis(name="time (s)", low=1.0, high=4.0, tics=[gearlash.Tic(2.0, "two")]),
        y=gearlash.PlotAxis(name="gap", low=0.1, high=10.0, logarithmic=True),
        layers=[layer("area", "apart", square), layer("line", "load", square),
                layer("line", "load", square), layer("marks", "impact", square)],
        texts=[gearlash.PlotText(at=gearlash.MapPoint(2.0, 1.0), text="here")])
    ax = plot.draw(panel)
    assert len(ax.collections[0].get_paths()) == 2
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["apart", "load", "impact"]
    assert (ax.get_xlim(), ax.get_yscale()) == ((1.0, 4.0), "log")
    assert [label.get_text() for label in ax.get_xticklabels()] == ["two"]
    assert ax.texts[0].get_text() == "here"


def test_a_sweep_over_one_axis(servo):
    data = gearlash.sweep(servo, {"servo.backlash": [0.1, 0.2, 0.3]}, ["amplitude"])
    ax = plot.sweep(data, unit="mrad", logarithmic=True)
    assert ax.lines[0].get_ydata() == pytest.approx(1e3 * data["amplitude"].values)
    assert ax.get_xlabel() == "servo.backlash (rad)"
    assert ax.get_ylabel() == "amplitude (mrad)" and ax.get_xscale() == "log"


def test_a_map_has_the_border_of_hunting(servo):
    data = gearlash.sweep(servo, {"servo.damping": "0.1:1.2:12", "servo.friction_ratio": "0.05:0.9:9"},
                          ["amplitude"])
    ax = plot.sweep(data)
    mesh = ax.collections[0]
    assert np.array_equal(mesh.get_array().reshape(12, 9), data["amplitude"].values)
    verdicts = gearlash.verdict_words(data)
    assert set(np.unique(verdicts)) == {"hunts", "cannot hunt"}
    border = np.concatenate([path.vertices for path in ax.collections[1].get_paths()])
    assert len(border) > 3
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("servo.friction_ratio", "servo.damping")


def test_the_distribution_of_a_production_run(servo):
    study = gearlash.tolerance(servo, {"servo.damping": gearlash.UniformBetween(0.2, 0.4)},
                               samples=1024)
    ax = plot.distribution(study, unit="deg")
    drawn = ax.patches[0].get_data()
    assert np.array_equal(drawn.values, study.histogram.counts)
    assert drawn.edges == pytest.approx(np.degrees(study.histogram.edges))
    assert "100.0% hunt" in ax.get_title()


def test_another_cycle_is_never_drawn_in_its_place():
    drive = gearlash.Drive.normal_form(0.01, 0.01, 0.5, 0.3, restitution=1.0)
    answer = gearlash.analyse(drive)
    unstable = [cycle for cycle in answer.cycles if cycle.stability == "unstable"]
    for cycle in unstable:
        with pytest.raises(ValueError, match="not stable"):
            plot.cycle(answer, cycle)


def test_what_cannot_be_drawn_is_said(servo):
    quiet = gearlash.analyse(gearlash.Drive.normal_form(0.9, 2, 0.5, 0.3))
    with pytest.raises(ValueError, match="cannot hunt"):
        plot.cycle(quiet)
    three = gearlash.sweep(servo, {"servo.damping": [0.1, 0.2], "servo.backlash": [0.1, 0.2],
                                   "servo.friction_ratio": [0.1, 0.2]}, ["amplitude"])
    with pytest.raises(ValueError, match="one or two axes"):
        plot.sweep(three)
    with pytest.raises(ValueError, match="unit"):
        plot.motion(gearlash.simulate(servo, 1.0), unit="furlong")


def test_notebooks_have_pictures_and_keep_no_figure(servo):
    answer = gearlash.analyse(servo)
    before = pyplot.get_fignums()
    assert answer._repr_png_().startswith(PNG)
    assert gearlash.simulate(servo, 2.0)._repr_png_().startswith(PNG)
    assert pyplot.get_fignums() == before
    assert gearlash.analyse(gearlash.Drive.normal_form(0.9, 2, 0.5, 0.3))._repr_png_() is None
    assert answer._repr_html_().startswith("<b>hunts")
