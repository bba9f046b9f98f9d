# %% [markdown]
# # The sensor before or after the gap
#
# The same drive with its sensor at the load, and at the motor.
# Give a folder as first argument to save the figures.

# %%
import sys
from pathlib import Path

import gearlash
from gearlash import plot

EXAMPLES = Path(__file__).resolve().parents[1]
FIGURES = Path(sys.argv[1]) if len(sys.argv) > 1 else None

# %%
drive = gearlash.Drive.from_toml(EXAMPLES / "first-servo.toml")
start = gearlash.Start(load_position=0.02)
for place in ("load", "motor"):
    one = drive.with_({"sensor.position": place})
    print(f"sensor at the {place}: {gearlash.analyse(one).headline}")
    axes = plot.motion(gearlash.simulate(one, 2.0, start=start), unit="mrad")
    if FIGURES:
        axes.figure.savefig(FIGURES / f"sensor-at-the-{place}.png", dpi=300)
