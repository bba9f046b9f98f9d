# %% [markdown]
# # A design chart of your own gearbox
#
# How large is the limit cycle over backlash and viscous friction of the load?
# Put the path of your own drive file in place of this one.
# Give a folder as first argument to save the figure.

# %%
import sys
from pathlib import Path

import gearlash
from gearlash import plot

EXAMPLES = Path(__file__).resolve().parents[1]
FIGURES = Path(sys.argv[1]) if len(sys.argv) > 1 else None

# %%
drive = gearlash.Drive.from_toml(EXAMPLES / "first-servo.toml")
print(gearlash.analyse(drive).headline)

# %% [markdown]
# Both begin at a quarter of their value in the file.
# Backlash ends at four times that value, and friction at a hundred times.

# %%
backlash, friction = drive["gearbox.backlash"], drive["load.friction"]
data = gearlash.sweep(drive, [
    gearlash.logarithmic("load.friction", friction / 4, friction * 100, 41),
    gearlash.logarithmic("gearbox.backlash", backlash / 4, backlash * 4, 41),
], ["amplitude", "frequency"])
hunts = int((data["amplitude"] > 0).sum())
print(f"{hunts} of {data['amplitude'].size} drives hunt")
print(f"largest amplitude: {float(data['amplitude'].max()):.6g} rad")

# %%
axes = plot.sweep(data, "amplitude", unit="mrad", logarithmic=True)
if FIGURES:
    axes.figure.savefig(FIGURES / "design-chart.png", dpi=300)
