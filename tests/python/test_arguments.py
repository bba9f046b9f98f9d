"""A wrong argument is named by the function that was called."""

import numpy as np
import pytest

import gearlash
from gearlash import thesis


@pytest.mark.parametrize(("name", "call"), [
    ("until", lambda servo: gearlash.simulate(servo, "1 s")),
    ("until", lambda servo: gearlash.simulate(servo, None)),
    ("until", lambda servo: gearlash.simulate(servo, True)),
    ("most_events", lambda servo: gearlash.simulate(servo, 1.0, most_events=1e4)),
    ("every", lambda servo: gearlash.simulate(servo, 1.0).sampled("0.1")),
    ("step", lambda servo: gearlash.compare({"a": servo}, step="1")),
    ("damping", lambda servo: gearlash.Drive.normal_form(None, 2, 0.1)),
    ("damping", lambda servo: gearlash.Drive.normal_form(True, 2, 0.1)),
    ("samples", lambda servo: gearlash.tolerance(servo, samples=1e3)),
    ("seed", lambda servo: gearlash.tolerance(servo, samples=64, seed=0.5)),
    ("units", lambda servo: gearlash.tune(servo, ["servo.damping"], units="many")),
    ("lines", lambda servo: thesis.printout("two")),
    ("start", lambda servo: gearlash.simulate(servo, 1.0, start=0.5)),
    ("servo", lambda servo: thesis.printout(servo=(0.1, 0.2))),
    ("machine", lambda servo: thesis.printout(machine=1)),
    ("damping", lambda servo: thesis.run("0.1", 1, 0.1)),
    ("progress", lambda servo: gearlash.analyse(servo, progress=3)),
    ("progress", lambda servo: gearlash.sweep(servo, {"servo.damping": [0.1]}, progress="yes")),
    ("proofs", lambda servo: gearlash.analyse(servo, proofs="yes")),
    ("motion_bytes", lambda servo: gearlash.analyse(servo, motion_bytes=1.5)),
    ("axes", lambda servo: gearlash.sweep(servo, {1: [0.1]})),
    ("axes", lambda servo: gearlash.sweep(servo, 3)),
    ("arrays", lambda servo: gearlash.sweep(servo, arrays={1: [0.1]})),
    ("parameters", lambda servo: gearlash.tune(servo, [3])),
    ("parameters", lambda servo: gearlash.derivatives(servo, ["amplitude"], [3])),
    ("varied", lambda servo: gearlash.tolerance(servo, {1: gearlash.Normal(1, 1)})),
    ("target", lambda servo: gearlash.design(servo, 3)),
    ("share", lambda servo: gearlash.widest_backlash(servo, "no-hunting", "half")),
    ("bins", lambda servo: gearlash.tolerance(servo, bins=0.5)),
    ("axes", lambda servo: gearlash.compare(servo, {1: [0.1]})),
    ("drives", lambda servo: gearlash.compare({1: servo})),
    ("quantities", lambda servo: gearlash.sweep(servo, {"servo.damping": [0.1]}, [1])),
    ("quantities", lambda servo: gearlash.sweep(servo, {"servo.damping": [0.1]}, "amplitude")),
    ("count", lambda servo: gearlash.linear("servo.damping", 0, 1, 2.0)),
    ("start", lambda servo: gearlash.logarithmic("servo.damping", "0.1", 1, 3)),
    ("drive", lambda servo: gearlash.tolerance("servo.toml")),
    ("drive", lambda servo: gearlash.tune(None)),
    ("arrays", lambda servo: gearlash.sweep(servo, arrays=[1, 2])),
    ("arrays", lambda servo: gearlash.sweep(servo, arrays={"servo.damping": [0.1, 0.2],
                                                           "servo.inertia_ratio": [1, 2, 3]})),
    ("arrays", lambda servo: gearlash.sweep(servo, arrays={"servo.damping": [0.1],
                                                           "damping": [0.2]})),
    ("client", lambda servo: gearlash.sweep(servo, {"servo.damping": [0.1]}, client=3)),
    ("varied must have one of ExactValue, UniformBetween, .* for servo.damping",
     lambda servo: gearlash.tolerance(servo, {"servo.damping": 0.1})),
    ("b", lambda servo: gearlash.interop.InertiaBacklash("x")),
    ("answer", lambda servo: gearlash.plot.cycle(3)),
    ("distribution must be one of gearlash.ExactValue, .*DiscreteLots",
     lambda servo: gearlash.tolerance(gearlash.TolerancedDrive(
         servo, [gearlash.ParameterTolerance("servo.damping", 0.1)])))])
def test_a_wrong_type(servo, name, call):
    wanted = name if " " in name else f"{name} must"
    with pytest.raises((TypeError, ValueError), match=wanted) as caught:
        call(servo)
    assert "incompatible function arguments" not in str(caught.value)


@pytest.mark.parametrize(("name", "call"), [
    ("most_events", lambda servo: gearlash.simulate(servo, 1.0, most_events=-1)),
    ("samples", lambda servo: gearlash.tolerance(servo, samples=0)),
    ("samples", lambda servo: gearlash.tolerance(servo, samples=-1)),
    ("seed", lambda servo: gearlash.tolerance(servo, samples=64, seed=-1)),
    ("motion_bytes = -1:", lambda servo: gearlash.analyse(servo, motion_bytes=-1)),
    ("bins = -1:", lambda servo: gearlash.tolerance(servo, samples=64, bins=-1)),
    ("count", lambda servo: gearlash.linear("servo.damping", 0, 1, -2)),
    ("quantity", lambda servo: gearlash.tolerance(servo, samples=64, quantity="speed")),
    ("share", lambda servo: gearlash.widest_backlash(servo, "no-hunting", 2.0)),
    ("shares", lambda servo: gearlash.tolerance(servo, samples=64, shares=[2])),
    ("quantity = speed:", lambda servo: gearlash.plot.curves(
        servo, {"servo.damping": [0.1, 0.2]}, "speed")),
    ("until", lambda servo: gearlash.simulate(servo, 10**400)),
    ("lines", lambda servo: thesis.printout(-1)),
    ("lines", lambda servo: thesis.printout(10**8))])
def test_a_value_out_of_range(servo, name, call):
    with pytest.raises(ValueError, match=f"{name} must"):
        call(servo)


def test_numpys_truth(servo):
    assert gearlash.analyse(servo, proofs=np.bool_(False)).certainty == "computed"


def test_a_masked_array_is_no_axis(servo):
    with pytest.raises(TypeError, match="servo.damping must not be a masked array"):
        gearlash.sweep(servo, {"servo.damping": np.ma.array([0.1, 0.5], mask=[0, 1])})


def test_a_word_is_not_chosen_by_a_number(example):
    joint = gearlash.Drive.from_toml(example("robot-joint.toml"))
    for one in ({"axes": {"sensor.position": [1, 2]}}, {"arrays": {"sensor.position": [1.0]}}):
        with pytest.raises(TypeError, match="sensor.position must be one of load, motor, both"):
            gearlash.sweep(joint, **one)
