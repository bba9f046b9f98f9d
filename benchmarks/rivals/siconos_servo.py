#!/usr/bin/python3
"""The servo through Siconos.

  siconos_servo.py SCHEME RESTITUTION STEP

SCHEME is time-stepping (Moreau-Jean) or event-driven (LSODAR). Prints amplitude, period and seconds
of the run, from the model's making on; interpreter and imports are not in it.
"""
import sys
from time import perf_counter

import numpy as np
import siconos.kernel as siconos

from reading import amplitude_and_period

DAMPING, INERTIA_RATIO, FRICTION_RATIO, BACKLASH = 0.19, 2.0, 0.1, 0.3
END, RECORDED = 200.0, 45.0  # s; only the last seconds are kept


def made_model(restitution):
    """Two shafts, state (motor, load), with both faces as unilateral constraints."""
    load_inertia = INERTIA_RATIO / (1 + INERTIA_RATIO)
    load_friction = FRICTION_RATIO * 2 * DAMPING
    shafts = siconos.LagrangianLinearTIDS(
        [-1.0, -1.0], [0.0, 0.0], np.diag([1 - load_inertia, load_inertia]),
        np.array([[0.0, 1.0], [0.0, 0.0]]),  # the motor feels the load's position
        np.diag([2 * DAMPING - load_friction, load_friction]))
    model = siconos.NonSmoothDynamicalSystem(0.0, END)
    model.insertDynamicalSystem(shafts)
    for face in (1.0, -1.0):  # face * (motor - load) <= backlash / 2
        room = siconos.LagrangianLinearTIR(np.array([[-face, face]]), np.array([BACKLASH / 2]))
        model.link(siconos.Interaction(siconos.NewtonImpactNSL(restitution), room), shafts)
    return model, shafts


def stepped(restitution, step):
    """Samples (time, load, load speed) by Moreau-Jean time stepping, theta = 1/2."""
    model, shafts = made_model(restitution)
    simulation = siconos.TimeStepping(model, siconos.TimeDiscretisation(0.0, step),
                                      siconos.MoreauJeanOSI(0.5), siconos.LCP())
    steps = round(END / step)
    first = steps - round(RECORDED / step)
    samples = np.empty((steps - first, 3))
    position, speed = shafts.q(), shafts.velocity()  # views of the state
    for index in range(steps):
        simulation.computeOneStep()
        if index >= first:
            samples[index - first] = ((index + 1) * step, position[1], speed[1])
        simulation.nextStep()
    return samples


def driven_by_events(restitution, step):
    """The same from event to event; the step is that of the output."""
    model, shafts = made_model(restitution)
    simulation = siconos.EventDriven(model, siconos.TimeDiscretisation(0.0, step), 0)
    simulation.insertIntegrator(siconos.LsodarOSI())
    simulation.insertNonSmoothProblem(siconos.LCP(), siconos.SICONOS_OSNSP_ED_IMPACT)
    simulation.insertNonSmoothProblem(siconos.LCP(), siconos.SICONOS_OSNSP_ED_SMOOTH_ACC)
    samples = []
    while simulation.hasNextEvent():
        simulation.advanceToEvent()
        try:
            simulation.processEvents()
        except Exception as fault:  # what the binding raises has no type of its own
            raise SystemExit(f"stopped at t = {simulation.nextTime():.3f} s: {fault}") from fault
        samples.append((simulation.startingTime(), shafts.q()[1], shafts.velocity()[1]))
    return np.array(samples)


if __name__ == "__main__":
    scheme, restitution, step = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
    start = perf_counter()
    samples = {"time-stepping": stepped, "event-driven": driven_by_events}[scheme](restitution, step)
    seconds = perf_counter() - start
    print(*(repr(float(value)) for value in amplitude_and_period(*samples.T)), seconds)
