# %% [markdown]
# # A design chart of your own gearbox
#
# How large is the limit cycle over the motor's viscous friction and the proportional gain?
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
# Both axes are by ratio. The orange line is the border of hunting.

# %%
friction, gain = drive["motor.friction"], drive["controller.proportional"]


def chart(count: int) -> list[gearlash.Axis]:
    return [gearlash.logarithmic("motor.friction", friction, 3000 * friction, count),
            gearlash.logarithmic("controller.proportional", gain / 10, 10 * gain, count)]


data = gearlash.sweep(drive, chart(31), ["amplitude", "frequency"])
words = gearlash.verdict_words(data)
for word in sorted(set(words.flat)):
    print(f"{word}: {(words == word).sum()} of {words.size} drives")
print(f"largest amplitude: {float(data['amplitude'].max()):.4g} rad")

# %%
axes = plot.map(drive, chart(9), unit="mrad")  # borders are found between its points
if FIGURES:
    axes.figure.savefig(FIGURES / "design-chart.png", dpi=300)
