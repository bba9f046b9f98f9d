"""Memory that the module loses, found by LeakSanitizer: every call, many times, in one process."""

import os
import re
import subprocess
import sys
import textwrap

import pytest

TIMES = 8

PROGRAM = textwrap.dedent("""
    import gc, sys
    import numpy as np
    import gearlash

    servo = gearlash.Drive.normal_form(0.19, 2, 0.1, 0.3)
    joint = gearlash.Drive.from_toml(sys.argv[1])
    varied = {"servo.damping": gearlash.Normal(0.3, 0.01)}

    def refused(call):
        try:
            call()
        except (ValueError, TypeError, KeyError):
            return
        raise SystemExit("was not refused")

    def stop(share):
        raise RuntimeError("stop")

    def stopped():
        try:
            gearlash.sweep(joint, {"gearbox.backlash": "1 mrad:4 mrad:20"}, progress=stop)
        except RuntimeError:
            pass

    def once():
        answer = gearlash.analyse(servo, loop=True)
        answer.to_json(), str(answer), answer.hunts, answer.largest_stable, answer.value("ceiling")
        motion = gearlash.simulate(servo, 5.0, start=gearlash.Start(load_position=0.1))
        motion.sampled(0.01), motion.at([0.0, 1.0]), motion.modes([0.5]), motion.events
        motion.touches, motion.energy, repr(motion)
        gearlash.sweep(servo, {"servo.damping": "0.1:0.4:50"})
        gearlash.sweep(servo, arrays={"servo.damping": np.linspace(0.1, 0.4, 50)})
        gearlash.design(servo, "no-hunting", ["servo.damping"])
        gearlash.margins(servo)
        gearlash.derivatives(servo, ["amplitude"], ["servo.damping"]).slope(
            "amplitude", "servo.damping")
        gearlash.tolerance(servo, varied, samples=32)
        gearlash.describe(servo)
        gearlash.thesis.printout(3)
        changed = joint.with_({"gearbox.backlash": 1e-3}).with_({"sensor.position": "motor"})
        changed.with_tolerances([gearlash.ParameterTolerance("gearbox.backlash",
                                                            gearlash.UniformAbout(1e-3, 1e-4))])
        changed.parameters(), changed.to_dict(), repr(changed), changed == joint
        refused(lambda: joint.with_({"gearbox.backlash": -1.0}))
        refused(lambda: joint.with_({"no.such": "x"}))
        refused(lambda: gearlash.simulate(servo, -1.0))
        refused(lambda: gearlash.simulate(servo, 1.0, start=gearlash.Start(gap="wide")))
        refused(lambda: gearlash.sweep(servo, arrays={"servo.damping": [np.nan]}))
        refused(lambda: gearlash.tolerance(servo, varied, samples=32, shares=["x"]))
        refused(lambda: gearlash.Answer(verdict="perhaps").hunts)
        stopped()

    for _ in range(int(sys.argv[2])):
        once()
    gc.collect()
    print("done")
""")


@pytest.mark.skipif("GEARLASH_SANITIZED" not in os.environ,
                    reason="needs the build of `make sanitize`")
def test_no_call_loses_memory():
    joint = os.path.join(os.path.dirname(__file__), "../../examples/robot-joint.toml")
    # The interpreter's own blocks come from malloc too, so that a lost reference is seen. It has no
    # frame pointers, so that stacks are unwound the slow way.
    child = subprocess.run(
        [sys.executable, "-c", PROGRAM, joint, str(TIMES)], capture_output=True, text=True,
        check=False, timeout=500,
        env={**os.environ, "PYTHONMALLOC": "malloc", "LSAN_OPTIONS": "exitcode=0",
             "ASAN_OPTIONS": "detect_leaks=1:fast_unwind_on_malloc=0:malloc_context_size=12:"
                             "symbolize=0"})
    assert child.stdout == "done\n", child.stderr[-4000:]
    assert "ERROR: AddressSanitizer" not in child.stderr, child.stderr[-4000:]
    # The interpreter itself loses thousands of blocks at its end: those that some call of ours made
    # each time are looked for.
    blocks = re.findall(r"leak of \d+ byte\(s\) in (\d+) object\(s\) allocated from:\n(.*?)\n\n",
                        child.stderr, re.S)
    assert blocks, "LeakSanitizer reported nothing at all"
    ours = [(int(count), frames) for count, frames in blocks
            if "/gearlash/_core" in frames and int(count) >= TIMES]
    assert not ours, "\n\n".join(frames for _, frames in ours)
