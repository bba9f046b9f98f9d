import csv
import io
import pickle

import numpy as np
import pytest

import gearlash


def test_samples_are_views_and_states_are_exact(servo):
    motion = gearlash.simulate(servo, 20.0, start=gearlash.Start(load_position=0.01))
    samples = motion.sampled(0.01)
    assert not samples.load_position.flags.owndata  # memory of C++
    assert samples.time.size == 2001 == samples["load_speed"].size
    assert np.array_equal(motion.at(samples.time).load_position, samples.load_position)
    held = samples.load_position
    total = held.sum()
    del motion, samples
    assert held.sum() == total  # the memory lives as long as its arrays


def test_any_times_of_any_shape(servo):
    motion = gearlash.simulate(servo, 5.0, start=gearlash.Start(load_position=0.1))
    times = np.linspace(0, 5, 12).reshape(3, 4)
    at = motion.at(times)
    assert at.load_position.shape == (3, 4)
    assert np.array_equal(motion.at(times[:, ::2]).time, times[:, ::2])
    assert np.array_equal(motion.at(times.astype(np.float32)).time, times.astype(np.float32))
    assert motion.at(2).time.shape == ()
    assert motion.modes([0.0]).tolist()[0]


def test_the_tool_samples_the_same(example, tool):
    drive = gearlash.Drive.from_toml(example("robot-joint.toml"))
    motion = gearlash.simulate(drive, 2.0)
    table = list(csv.reader(io.StringIO(
        tool("simulate", example("robot-joint.toml"), "--until", "2 s", "--every", "0.1 s"))))
    rows = [row for row in table if row and row[0][0].isdigit()]
    ours = motion.sampled(0.1)
    assert [float(row[0]) for row in rows] == ours.time.tolist()
    head = next(row for row in table if row[0].startswith("time"))
    load = next(i for i, name in enumerate(head) if name.startswith("load_position")
                or name.startswith("load position"))
    assert [float(row[load]) for row in rows] == ours.load_position.tolist()


def test_events_are_a_structured_array(servo):
    motion = gearlash.simulate(servo, 30.0, start=gearlash.Start(load_position=0.05))
    events = motion.events
    assert events.dtype == gearlash._motion.EVENT
    assert (np.diff(events["time"]) >= 0).all()
    hits = events[np.char.startswith(events["what"], "impact")]
    assert hits.size > 2 and (hits["energy_lost"] > 0).all()
    assert motion.energy.stored_at_start + motion.energy.supplied == pytest.approx(
        motion.energy.stored + motion.energy.motor_friction + motion.energy.load_friction
        + motion.energy.impacts, rel=1e-9)


def test_a_motion_can_be_pickled(servo):
    motion = gearlash.simulate(servo, 3.0, start=gearlash.Start(load_position=0.1))
    copy = pickle.loads(pickle.dumps(motion))
    assert copy.sampled(0.01) == motion.sampled(0.01) and copy.drive == servo


def test_samples_can_be_pickled(servo):
    samples = gearlash.simulate(servo, 1.0).sampled(0.1)
    copy = pickle.loads(pickle.dumps(samples))
    assert copy == samples and copy != gearlash.simulate(servo, 2.0).sampled(0.1)


@pytest.mark.parametrize(("times", "error"), [
    ([0.0, np.nan], ValueError), (["a"], TypeError), ([1j], TypeError), (None, TypeError),
    ([object()], TypeError), ([True], TypeError)])
def test_bad_times(servo, times, error):
    with pytest.raises(error, match="times"):
        gearlash.simulate(servo, 1.0).at(times)


@pytest.mark.parametrize("time", [-1e-9, 1.0 + 1e-9, np.inf])
def test_times_outside_the_motion(servo, time):
    with pytest.raises(gearlash.InvalidInput, match="end of the motion"):
        gearlash.simulate(servo, 1.0).at([0.5, time])


def test_too_many_samples_are_refused(servo):
    for every in (1e-19, 1e-300, 1e-9):
        with pytest.raises(gearlash.InvalidInput, match="100,000,000"):
            gearlash.simulate(servo, 5.0).sampled(every)


def test_bad_spans(servo):
    for until in (-1.0, float("nan"), float("inf"), 1e300):
        with pytest.raises(gearlash.InvalidInput):
            gearlash.simulate(servo, until)
    with pytest.raises(gearlash.InvalidInput):
        gearlash.simulate(servo, 1.0).sampled(0.0)
    with pytest.raises(gearlash.InvalidInput):
        gearlash.simulate(servo, 1.0, start=gearlash.Start(gap=1.0))
