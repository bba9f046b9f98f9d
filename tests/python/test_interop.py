from types import SimpleNamespace

import numpy as np
import pytest
from scipy import integrate, signal

import gearlash
from gearlash import interop

SHAFTS = {"motor": {"kind": "torque-controlled", "inertia": 2e-6, "friction": 1e-5},
          "gearbox": {"ratio": 20, "backlash": 2e-3}, "load": {"inertia": 5e-3, "friction": 1e-3}}


def control_transfer_function(num, den, dt=0):
    """A stand-in with the attributes of control.TransferFunction: lists of lists of arrays."""
    return SimpleNamespace(num=[[np.array(num)]], den=[[np.array(den)]], dt=dt, ninputs=1,
                           noutputs=1)


def control_state_space(A, B, C, D, dt=0):
    """A stand-in with the attributes of control.StateSpace."""
    return SimpleNamespace(A=np.array(A), B=np.array(B), C=np.array(C), D=np.array(D), dt=dt)


def drive_with(system):
    return gearlash.Drive(**SHAFTS, **interop.controller(system))


def test_every_form_of_one_controller_gives_the_same_motion():
    lead = signal.TransferFunction([0.05, 20.0], [0.001, 1.0])
    space = lead.to_ss()
    forms = [lead, lead.to_zpk(), space, control_transfer_function(lead.num, lead.den),
             control_state_space(space.A, space.B, space.C, space.D)]
    start = gearlash.Start(load_position=0.01)
    motions = [gearlash.simulate(drive_with(form), 0.2, start=start).at([0.05, 0.1, 0.2])
               for form in forms]
    for motion in motions[1:]:
        assert motion.load_position == pytest.approx(motions[0].load_position, rel=1e-9)
    own = gearlash.Drive(**SHAFTS, controller={"kind": "lead-lag", "gain": 20.0, "zero": 400.0,
                                               "pole": 1000.0})
    assert gearlash.simulate(own, 0.2, start=start).at([0.2]).load_position == pytest.approx(
        motions[0].load_position[-1:], rel=1e-9)


@pytest.mark.parametrize("system", [
    signal.dlti([20.0, -19.0], [1.0, -0.5], dt=1e-3),
    control_transfer_function([20.0, -19.0], [1.0, -0.5], 1e-3)])
def test_a_system_in_z_brings_its_sampling(system):
    drive = drive_with(system)
    assert drive["sampling.period"] == 1e-3 and drive["controller.variable"] == "z"


def test_shafts_from_plants():
    position = signal.TransferFunction([2.0], [0.01, 0.002, 0.0])
    speed = control_transfer_function([2.0], [0.01, 0.002])
    assert interop.shaft(position) == interop.shaft(speed) == {"inertia": 0.005, "friction": 0.001}


@pytest.mark.parametrize(("system", "error"), [
    (3, TypeError), (SimpleNamespace(num=[[[1.0]], [[2.0]]], den=[[[1.0]], [[2.0]]]), ValueError),
    (signal.dlti([1.0], [1.0, 0.5], dt=True), ValueError),
    (control_state_space(np.eye(2), np.ones((2, 2)), np.ones((1, 2)), np.zeros((1, 2))), ValueError),
    (control_transfer_function([np.nan], [1.0, 2.0]), ValueError)])
def test_other_systems_are_refused(system, error):
    with pytest.raises(error):
        interop.controller(system)


def test_other_plants_are_refused():
    for system in (signal.TransferFunction([1.0, 1.0], [1.0, 1.0, 0.0]),
                   signal.TransferFunction([1.0], [1.0, 1.0, 1.0]),
                   signal.dlti([1.0], [1.0, 0.5], dt=1.0)):
        with pytest.raises(ValueError, match="shaft"):
            interop.shaft(system)


def test_the_describing_function_is_the_first_harmonic():
    """Beside the first harmonic of the load's motion, worked out by quadrature."""
    gap, amplitude = 0.3, 0.8
    # The input is A sin t. It parts at its fastest point, t = 0 (forward), and meets the other face
    # where the load, going on at the speed A, is a gap ahead: A t - A sin t = gap.
    angle = np.linspace(0.0, np.pi, 200_001)
    contact = np.interp(gap, amplitude * (angle - np.sin(angle)), angle)

    def load(time):
        """On the backward face after the contact; half a period later mirrored."""
        coasting = amplitude * time + 0.5 * gap - gap
        return np.where(time < contact, coasting, amplitude * np.sin(time) + 0.5 * gap)

    def part(weight):
        whole = integrate.quad(lambda t: float(load(t)) * weight(t), 0.0, np.pi,
                               points=[contact], epsabs=1e-12)[0]
        return 2.0 * whole / (np.pi * amplitude)

    expected = part(np.sin) + 1j * part(np.cos)
    found = interop.InertiaBacklash(gap).describing_function(amplitude)
    assert found == pytest.approx(expected, abs=1e-7)


def test_the_describing_function_has_the_form_of_python_control():
    nonlinearity = interop.InertiaBacklash(0.3)
    gains = nonlinearity.describing_function(np.array([[0.5, 1.0], [2.0, 1e6]]))
    assert gains.shape == (2, 2) and gains[1, 1] == pytest.approx(1.0, abs=1e-3)
    assert not nonlinearity._isstatic()
    assert eval(repr(nonlinearity), vars(interop)).b == 0.3
    with pytest.raises(NotImplementedError):
        nonlinearity(1.0)
    with pytest.raises(gearlash.InvalidInput):
        interop.InertiaBacklash(-1.0)
    with pytest.raises(gearlash.InvalidInput):
        nonlinearity.describing_function(0.0)


@pytest.mark.parametrize(("call", "wanted"), [
    (lambda: interop.shaft(signal.TransferFunction([-1.0], [1.0, 1.0, 0.0])), "an inertia above 0"),
    (lambda: interop.shaft(signal.TransferFunction([1.0], [1.0, -1.0, 0.0])), "a friction from 0 on"),
    (lambda: interop.controller(signal.TransferFunction([1.0], [1.0, 1.0]), shaft="foo"),
     "shaft must be one of load, motor, mixed"),
    (lambda: interop.controller(control_transfer_function([1.0, 0.0, 0.0], [1.0, 1.0])),
     "num must be of no higher degree than den"),
    (lambda: interop.controller(control_transfer_function([1.0], [0.0])), "den must not be 0")])
def test_what_no_drive_can_have_is_refused(call, wanted):
    with pytest.raises(ValueError, match=wanted):
        call()
