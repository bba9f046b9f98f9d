"""A user's program, for `mypy --strict`: what is right is accepted without casts."""

from __future__ import annotations

import numpy as np
import xarray

import gearlash
from gearlash import Axis, Drive, plot, thesis

drive = Drive.from_toml("drive.toml")
half: float = drive["gearbox.backlash"] / 2
ratio: float = drive.gearbox.ratio * 2.0
is_pd: bool = drive["controller.kind"] == "PD"
changed: Drive = drive.with_({"gearbox.backlash": np.float32(1e-3), "sensor.position": "motor",
                              "sampling": None, "reference.times": [0.0, 1.0],
                              "load.inertia": {"min": 1e-3, "max": 2e-3}})

answer = gearlash.analyse(drive, loop=True, progress=lambda share: share < 0.5)
cycle = answer.largest_stable
if cycle is not None:
    peak: float = 2 * cycle.amplitude * cycle.frequency
ceiling: float | None = answer.value("ceiling")
is_quiet = answer.verdict in ("cannot hunt", "comes to rest")
limit = gearlash.QuantityLimit("motor_amplitude", gearlash.Bounds(0.0, 1e-3))

axes = [Axis("gearbox.backlash", [1e-3, 2e-3]), Axis("load.inertia", np.geomspace(1e-3, 1e-2, 5)),
        gearlash.linear("gearbox.ratio", 10, 20, 3)]
data = gearlash.sweep(drive, axes, ["amplitude"])
dims: tuple[object, ...] = data["amplitude"].dims
largest: float = float(data["amplitude"].max())
dataset: xarray.Dataset = gearlash.sweep(drive, arrays={"gearbox.backlash": np.array([1e-3])})
words = gearlash.verdict_words(data)

places = gearlash.compare({"drive": drive, "changed": changed}, quantities=["amplitude"])["drives"]

motion = gearlash.simulate(drive, 1.0, start=gearlash.Start(load_position=0.1))
last: float = float(motion.at([0.0, 1.0]).load_position[-1])
impacts = motion.events[motion.events["what"] == "impact forward"]

found = gearlash.design(drive, "no-hunting", ["gearbox.backlash", axes[0]])["gearbox.backlash"]
nearest: float | None = found.nearest
study = gearlash.tolerance(drive, {"load.inertia": gearlash.Normal(5e-3, 1e-4)}, shares=(0.5,), bins=0)
share: float = study.hunting.value
tuned = gearlash.tune(drive, ["controller.proportional=1:10"], units=8, rounds=2)
rows = thesis.printout(3, (0.19, 2.0, 0.1, 0.3))[:, 0]
plot.motion(motion)

# What is wrong is refused.
gearlash.simulate(drive, "1 s")  # type: ignore[arg-type]
gearlash.analyse("drive.toml")  # type: ignore[arg-type]
gearlash.Start(position=1.0)  # type: ignore[call-arg]
answer.amplitude  # type: ignore[attr-defined]
answer.verdict == "rests"  # type: ignore[comparison-overlap]
gearlash.QuantityLimit("speed")  # type: ignore[arg-type]
gearlash.tune(drive, aim="speed")  # type: ignore[arg-type]
