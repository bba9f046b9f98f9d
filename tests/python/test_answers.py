import json
import math
import pickle

import pytest

import gearlash


def without_provenance(report):
    """The report without what made it."""
    if isinstance(report, dict):
        return {key: without_provenance(value) for key, value in report.items()
                if key not in ("provenance", "version", "command")}
    return [without_provenance(one) for one in report] if isinstance(report, list) else report


def test_numbers_of_the_sample_servo(servo):
    answer = gearlash.analyse(servo)
    cycle = answer.largest_stable
    assert (answer.verdict, answer.certainty, answer.engine) == ("hunts", "enclosed", "closed form")
    assert cycle.amplitude == pytest.approx(0.241611108, abs=5e-10)
    assert cycle.period == pytest.approx(6.456205, abs=5e-7)
    assert answer.value("frequency") == cycle.frequency == 1 / cycle.period
    assert answer.hunts and answer.drive == servo
    assert answer.ceiling.load / 0.3 == pytest.approx(0.8542, abs=5e-5)
    spec = answer.ceiling.widest_backlash(0.1, 0.3)
    assert spec == pytest.approx(0.1 / answer.ceiling.load * 0.3, rel=1e-12)


@pytest.mark.parametrize("name", ["elinco-fd162.toml", "robot-joint.toml", "normalized.toml"])
def test_json_is_that_of_the_tool(example, tool, name):
    drive = gearlash.Drive.from_toml(example(name))
    ours = gearlash.analyse(drive, loop=True, step=True).to_dict()
    theirs = json.loads(tool("limit-cycle", example(name), "--format", "json"))
    assert without_provenance(ours) == without_provenance(theirs)


@pytest.mark.parametrize("command", ["describe", "compare"])
def test_reports_are_those_of_the_tool(example, tool, command):
    file = example("elinco-fd162.toml")
    report = getattr(gearlash, command)(gearlash.Drive.from_toml(file))
    theirs = json.loads(tool(command, file, "--format", "json"))
    assert without_provenance(report) == without_provenance(theirs)
    assert str(report).strip()


def test_comparisons_are_those_of_the_tool(example, tool, servo):
    file = example("elinco-fd162.toml")
    drive = gearlash.Drive.from_toml(file).with_({"specification.step": "1 rad"})
    ours = gearlash.compare(drive, {"gearbox.backlash": [0.1, 0.2]}, ["amplitude"])
    theirs = json.loads(tool("compare", file, "--x", "gearbox.backlash=0.1,0.2", "--quantities",
                             "amplitude", "--step", "1 rad", "--format", "json"))
    assert without_provenance(ours) == without_provenance(theirs)
    files = {name: example(f"{name}.toml") for name in ("elinco-fd162", "dynamixel-joint")}
    ours = gearlash.compare({name: gearlash.Drive.from_toml(file) for name, file in files.items()})
    theirs = json.loads(tool("compare", *files.values(), "--format", "json"))
    assert without_provenance(ours) == without_provenance(theirs)


def test_a_comparison_has_one_axis_or_several_drives(servo):
    with pytest.raises(ValueError, match="axes must be one, not 2"):
        gearlash.compare(servo, {"servo.damping": [0.1], "servo.backlash": [0.1]})
    with pytest.raises(TypeError, match="axes need one drive"):
        gearlash.compare({"a": servo}, {"servo.damping": [0.1]})
    with pytest.raises(gearlash.InvalidInput, match="servo.damping"):
        gearlash.compare(servo, [gearlash.Axis("servo.damping", [-1.0])])
    with pytest.raises(gearlash.InvalidInput, match="drives = 0: must be from 1 to 100"):
        gearlash.compare({})
    with pytest.raises(gearlash.InvalidInput, match=r"step = 0.*\n.*until = -1"):
        gearlash.compare({"a": servo}, step=0.0, until=-1.0)


def test_what_is_not_a_sequence_is_refused(servo, pd_drive):
    for call in (lambda: gearlash.compare(pd_drive, "load"),
                 lambda: gearlash.compare(pd_drive, quantities="amplitude"),
                 lambda: gearlash.derivatives(servo, "amplitude", ["servo.damping"]),
                 lambda: gearlash.sweep(servo, {"servo.damping": [0.1]}, "amplitude"),
                 lambda: gearlash.design(servo, "no-hunting", "servo.damping")):
        with pytest.raises(TypeError, match="sequence"):
            call()


def test_nothing_but_a_drive_is_analysed(servo):
    class Duck:
        _core = property(lambda self: servo.with_({"servo.damping": 0.2})._core)

    with pytest.raises(TypeError, match="gearlash.Drive"):
        gearlash.analyse(Duck())


def test_derivatives(servo):
    slopes = gearlash.derivatives(servo, ["amplitude", "period"],
                                  ["servo.backlash", "servo.damping"])
    step = 1e-6
    ends = [gearlash.analyse(servo.with_({"servo.damping": 0.19 + by})).value("amplitude")
            for by in (-step, step)]
    assert slopes.slope("amplitude", "servo.damping") == pytest.approx(
        (ends[1] - ends[0]) / (2 * step), rel=1e-7)
    assert slopes.slope("period", "servo.backlash") == pytest.approx(0.0, abs=1e-12)
    assert slopes.elasticity("amplitude", "servo.backlash") == pytest.approx(1.0, rel=1e-12)


def test_a_jacobian_has_what_it_was_asked_for(servo):
    slopes = gearlash.derivatives(servo, ["amplitude"], ["servo.damping"])
    with pytest.raises(KeyError, match="servo.damping"):
        slopes.slope("amplitude", "servo.backlash")
    with pytest.raises(KeyError, match="amplitude"):
        slopes.elasticity("period", "servo.damping")


def test_hunting_is_what_a_tolerance_study_counts():
    hunting = {word for word in gearlash._core.words()["Verdict"]
               if gearlash.Answer(verdict=word).hunts}
    assert hunting == {"hunts", "hunts if disturbed", "hunts irregularly", "grows without bound",
                       "runs away", "runs away if disturbed", "undamped"}


def test_quantities_are_the_registry():
    known = {info.name: info.unit for info in gearlash.quantities()}
    assert known["amplitude"] == "rad" and known["settling_time"] == "s"


def test_text_and_notebook(servo):
    answer = gearlash.analyse(servo)
    assert answer.headline in str(answer)
    assert "0.242" in answer._repr_html_()


def test_restitution_and_rest():
    bouncing = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3, restitution=0.3)
    assert gearlash.analyse(bouncing).value("amplitude") == pytest.approx(0.24010464, abs=5e-9)
    quiet = gearlash.analyse(gearlash.Drive.normal_form(0.9, 2, 0.5, 0.3))
    assert quiet.verdict == "cannot hunt" and not quiet.hunts and quiet.value("amplitude") == 0.0
    assert quiet.largest_stable is None and not math.isnan(quiet.growth_at_rest)


def test_a_search_that_keeps_little_of_a_motion_has_the_same_verdict(example):
    drive = gearlash.Drive.from_toml(example("telescope-axis.toml"))
    whole = gearlash.analyse(drive, borders=False)
    assert whole.verdict == "hunts"
    assert gearlash.analyse(drive, borders=False, motion_bytes=0).headline == whole.headline


def test_a_headline_is_that_of_the_tool_in_the_unit_of_the_file(example, tool):
    file = example("telescope-axis.toml")
    drive = gearlash.Drive.from_toml(file)
    answer = gearlash.analyse(drive)
    assert " arcmin " in answer.headline
    assert answer.headline == tool("limit-cycle", file, "--brief").strip()
    friction = f"{drive['load.friction']!r} N m s/rad"
    for same in (pickle.loads(pickle.dumps(drive)), drive.with_tolerances([]),
                 drive.with_({"gearbox.backlash": drive["gearbox.backlash"]}),
                 drive.with_({"load.friction": friction})):
        assert same == drive and hash(same) == hash(drive)
        assert gearlash._core.headline(same, answer) == answer.headline
    degrees = drive.with_({"gearbox.backlash": "0.2 deg"})
    assert " deg " in gearlash._core.headline(degrees, answer)
    in_si = gearlash.Drive.from_toml(drive.to_toml())
    assert in_si == drive and " rad " in gearlash._core.headline(in_si, answer)
