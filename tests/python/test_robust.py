"""Threads, forks, Ctrl-C, progress and memory at the boundary of the module."""

import ctypes
import ctypes.util
import gc
import multiprocessing
import os
import platform
import resource
import signal
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest

import gearlash


def small_sweep(servo):
    return gearlash.sweep(servo, {"servo.damping": "0.1:0.9:200", "servo.inertia_ratio": "0.5:4:20"},
                          ["amplitude"])["amplitude"].values


def test_two_threads_at_once(servo, pd_drive):
    expected = small_sweep(servo)
    searched = gearlash.analyse(pd_drive)
    found = {}

    def work(number):
        found[number] = (small_sweep(servo), gearlash.analyse(pd_drive))

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for values, answer in found.values():
        assert np.array_equal(values, expected, equal_nan=True)
        assert answer == searched


def test_other_python_threads_run_meanwhile(pd_drive):
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.001):
            ticks.append(None)

    ticker = threading.Thread(target=tick)
    ticker.start()
    gearlash.sweep(pd_drive, {"controller.proportional": "5:40:12"}, ["amplitude"])
    stop.set()
    ticker.join()
    assert len(ticks) > 3


def in_a_fork(servo, queue):
    queue.put(small_sweep(servo))


def test_a_fork_after_work_in_the_parent(servo):
    expected = small_sweep(servo)
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=in_a_fork, args=(servo, queue))
    child.start()
    found = queue.get(timeout=60)
    child.join(timeout=60)
    assert child.exitcode == 0
    assert np.array_equal(found, expected, equal_nan=True)


def test_ctrl_c_interrupts():
    program = textwrap.dedent("""
        import gearlash, sys
        drive = gearlash.Drive.from_toml(sys.argv[1])
        print("begun", flush=True)
        try:
            gearlash.sweep(drive, {"controller.proportional": "100 V/rad:1000 V/rad:4000"})
        except KeyboardInterrupt:
            print("interrupted", flush=True)
    """)
    joint = os.path.join(os.path.dirname(__file__), "../../examples/robot-joint.toml")
    child = subprocess.Popen([sys.executable, "-c", program, joint], stdout=subprocess.PIPE,
                             text=True)
    assert child.stdout.readline() == "begun\n"
    threading.Timer(0.3, child.send_signal, [signal.SIGINT]).start()
    out, _ = child.communicate(timeout=60)
    assert out == "interrupted\n"


def test_progress_reports_and_stops(pd_drive):
    shares = []
    gearlash.sweep(pd_drive, {"controller.proportional": "5:40:600"}, ["amplitude"],
                   progress=shares.append)
    assert shares == sorted(shares) and 0 <= shares[0] <= shares[-1] <= 1
    stopped = gearlash.sweep(pd_drive, {"controller.proportional": "5:40:400"}, ["amplitude"],
                             progress=lambda share: False)
    assert np.isnan(stopped["amplitude"].values).any()


def test_an_exception_of_progress_is_raised(pd_drive):
    def fail(share):
        raise RuntimeError("no more")

    with pytest.raises(RuntimeError, match="no more"):
        gearlash.sweep(pd_drive, {"controller.proportional": "5:40:400"}, progress=fail)


@pytest.mark.skipif("GEARLASH_SANITIZED" in os.environ,
                    reason="AddressSanitizer keeps freed memory for a while")
def test_memory_does_not_grow(servo, pd_drive):
    def once():
        answer = gearlash.analyse(servo)
        answer.to_json()
        motion = gearlash.simulate(servo, 50.0, start=gearlash.Start(load_position=0.1))
        motion.sampled(0.001).load_position.sum()
        motion.events
        gearlash.sweep(servo, arrays={"servo.damping": np.linspace(0.1, 0.5, 20_000)})
        for bad in ({"gearbox.backlash": -1.0}, {"no.such": 1.0}):
            with pytest.raises(gearlash.InvalidInput):
                pd_drive.with_(bad)

    def used():
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    for _ in range(30):
        once()
    before = used()
    for _ in range(120):
        once()
    assert used() - before < 4_000  # kB; one of these calls keeps 400 kB in arrays alone


def test_daemon_threads_in_long_calls_do_not_abort_the_exit():
    """Each long call, over and over, in a thread of its own, when the interpreter ends."""
    program = textwrap.dedent("""
        import gearlash, itertools, sys, threading, time
        series = gearlash.Drive.from_toml(sys.argv[1])
        servo = gearlash.Drive.normal_form(damping=0.19, inertia_ratio=2, friction_ratio=0.1,
                                           backlash=0.3)
        motion = gearlash.simulate(servo, until=1e4)
        told = lambda share: sum(range(1000)) > 0
        calls = [
            lambda: gearlash.analyse(series, progress=told),
            lambda: gearlash.derivatives(servo, ["amplitude"], ["servo.damping"]),
            lambda: gearlash.describe(series),
            lambda: gearlash.compare(series),
            lambda: gearlash.design(servo, "no-hunting"),
            lambda: gearlash.margins(servo),
            lambda: gearlash.tolerance(series, samples=512, progress=told),
            lambda: gearlash.sensitivity_indices(series, samples=512),
            lambda: gearlash.widest_backlash(series, "no-hunting"),
            lambda: gearlash.tune(series, progress=told),
            lambda: gearlash.simulate(series, until=100.0),
            lambda: motion.sampled(1e-3),
            lambda: gearlash.sweep(servo, {"servo.damping": "0.1:0.9:2000"}, progress=told),
            lambda: gearlash.thesis.printout(machine=True),
        ]
        begun = [threading.Event() for call in calls]

        def repeat(call, event):
            while True:
                event.set()
                try:
                    call()
                except (TypeError, AttributeError):
                    raise
                except Exception:
                    pass

        for call, event in zip(calls, begun):
            threading.Thread(target=repeat, args=(call, event), daemon=True).start()
        for event in begun:
            event.wait()
        time.sleep(float(sys.argv[2]))
        print("leaving", flush=True)
    """)
    joint = os.path.join(os.path.dirname(__file__), "../../examples/toleranced-joint.toml")
    for pause in ("0.01", "0.3", "1"):
        done = subprocess.run([sys.executable, "-c", program, joint, pause], capture_output=True,
                              text=True, check=False, timeout=60)
        assert (done.returncode, done.stdout) == (0, "leaving\n"), done.stderr
        assert done.stderr == ""


# Downward, upward and toward 0, as <fenv.h> numbers them.
ROUNDING_MODES = {"x86_64": (0x400, 0x800, 0xC00), "aarch64": (0x800000, 0x400000, 0xC00000)}


def test_nothing_is_proved_with_another_rounding_mode():
    """Other software may change how a thread rounds: its answers are computed, and say why."""
    if platform.machine() not in ROUNDING_MODES:
        pytest.skip("the numbers of its rounding modes are not known")
    libm = ctypes.CDLL(ctypes.util.find_library("m"))
    theorem = gearlash.Drive.normal_form(damping=1, inertia_ratio=1, friction_ratio=0.5, backlash=1)
    enclosed = gearlash.Drive.normal_form(damping=0.19, inertia_ratio=2, friction_ratio=0.1,
                                          backlash=0.3)
    by_energy = gearlash.Drive(
        motor={"kind": "torque-controlled", "inertia": 1.0, "friction": 2.0},
        gearbox={"ratio": 1, "backlash": 0.1}, load={"inertia": 1.0, "friction": 2.0},
        sensor={"position": "motor"},
        controller={"kind": "PD", "proportional": 1.0, "derivative": 1.0, "filter": 0.05})
    drives = (theorem, enclosed, by_energy)
    answers = {}

    def work(mode):
        before = libm.fegetround()
        try:
            assert mode is None or libm.fesetround(mode) == 0
            answers[mode] = [gearlash.analyse(drive) for drive in drives]
        finally:
            libm.fesetround(before)

    for mode in (None, *ROUNDING_MODES[platform.machine()]):
        thread = threading.Thread(target=work, args=(mode,))
        thread.start()
        thread.join()
    proved = ("enclosed", "theorem")
    for mode, found in answers.items():
        for answer in found:
            is_usual = mode is None
            assert (str(answer.certainty) in proved) == is_usual
            assert any(note.code == "arithmetic" for note in answer.notes) != is_usual
            assert all((str(cycle.certainty) in proved) == is_usual for cycle in answer.cycles)
            assert (answer.ceiling.load is not None) == is_usual
            assert is_usual or (answer.bounds is None and answer.ceiling.mesh_torque is None)
