import json

import pytest

import gearlash


def test_a_design_is_that_of_the_tool(example, tool):
    file = example("elinco-fd162.toml")
    drive = gearlash.Drive.from_toml(file)
    theirs = json.loads(tool("design", file, "--target", "no-hunting", "--parameters",
                             "gearbox.ratio,load.friction", "--format", "json"))
    ours = gearlash.design(drive, "no-hunting", ["gearbox.ratio", "load.friction"])
    for one in theirs["design"]["parameters"]:
        found = ours[one["values"]["parameter"]]
        assert found.nearest == one["values"]["nearest"]
        assert found.nearest in found and found.present not in found


def test_a_searched_design_puts_its_value_back(pd_drive):
    asked = ["gearbox.backlash=0.2 mrad:4 mrad:6"]
    hunting = pd_drive.with_({"controller.proportional": 30.0})
    found = gearlash.design(hunting, "amplitude <= 1 mrad", asked)["gearbox.backlash"]
    value = found.intervals[-1].high
    met = gearlash.analyse(hunting.with_({"gearbox.backlash": value}))
    missed = gearlash.analyse(hunting.with_({"gearbox.backlash": 1.01 * value}))
    assert met.value("amplitude") <= 1e-3 < missed.value("amplitude")


def test_progress_of_a_design_rises_to_the_end_and_stops(pd_drive):
    asked = ["gearbox.backlash=0.5 mrad:4 mrad:40", "controller.proportional=5:40:40"]
    shares = []
    gearlash.design(pd_drive, "no-hunting", asked, progress=shares.append)
    assert shares == sorted(shares)
    calls = []
    gearlash.design(pd_drive, "no-hunting", asked,
                    progress=lambda share: calls.append(share) or False)
    assert len(calls) <= 1


def test_margins(servo):
    margin = gearlash.margins(servo)
    assert margin.hunts and margin.growth_at_rest > 1
    of_damping = next(one for one in margin.parameters if one.parameter == "load.friction")
    assert of_damping.above is not None


def test_a_tolerance_study_is_that_of_the_tool(example, tool):
    file = example("toleranced.toml")
    theirs = json.loads(tool("tolerance", file, "--samples", "1024", "--format", "json"))
    drive = gearlash.Drive.from_toml(file)
    study = gearlash.tolerance(drive, samples=1024)
    assert study.hunting.value == theirs["study"]["hunting"]["value"]
    wider = gearlash.tolerance(gearlash.series(drive), {
        drive.tolerances[0].path: gearlash.ExactValue(drive[drive.tolerances[0].path])}, samples=1024)
    assert wider.hunting != study.hunting


@pytest.mark.parametrize("error", [0.0, -0.1, 0.7, float("nan")])
def test_a_bad_error_of_a_study_is_refused(servo, error):
    with pytest.raises(gearlash.InvalidInput, match="error"):
        gearlash.tolerance(servo, {"servo.damping": gearlash.UniformBetween(0.2, 0.3)}, error=error)


def test_indices_and_widest_backlash(servo):
    varied = {"servo.damping": gearlash.UniformBetween(0.15, 0.25),
              "servo.friction_ratio": gearlash.UniformBetween(0.09, 0.11)}
    study = gearlash.sensitivity_indices(servo, varied, samples=4096)
    damping, friction = (one.of_amplitude.total.value for one in study.numbers)
    assert damping > friction > 0
    found = gearlash.widest_backlash(servo, "amplitude <= 0.3", 0.9, varied=varied, samples=2048)
    put_back = gearlash.tolerance(servo, {**varied, "servo.backlash": gearlash.UniformBetween(
        found.min, found.max)}, target="amplitude <= 0.3", samples=2048)
    assert put_back.yield_.value == pytest.approx(0.9, abs=0.01)


def test_tune_meets_its_target(pd_drive):
    tuned = gearlash.tune(pd_drive, ["controller.proportional=2:40"], target="amplitude <= 2 mrad",
                          units=1)
    assert tuned.meets
    assert gearlash.analyse(tuned.drive).value("amplitude") <= 2e-3
    assert tuned.drive["controller.proportional"] == tuned.values[0]
