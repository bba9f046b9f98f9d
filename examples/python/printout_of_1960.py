# %% [markdown]
# # The printout of 1960
#
# N. C. New's thesis prints the motion of a servo, line by line, as Table II.
# Its program runs here again, once in double precision and once on an emulated CDC 1604.
# Beside it stands the exact motion, which has no step size.
# Give a folder as first argument to save the figure.

# %%
import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot

import gearlash
from gearlash import thesis

FIGURES = Path(sys.argv[1]) if len(sys.argv) > 1 else None

# %%
printed = thesis.table_2()
port = thesis.printout(len(printed))
machine = thesis.printout(len(printed), machine=True)

# %% [markdown]
# The largest difference from the printed table, column by column.

# %%
for place, name in enumerate(thesis.COLUMNS):
    print(f"{name}: port {np.abs(port - printed)[:, place].max():.2e}, "
          f"machine {np.abs(machine - printed)[:, place].max():.2e}")

# %% [markdown]
# The exact step response of the same servo, beside the printed load position.

# %%
servo = gearlash.Drive.normal_form(damping=0.2, inertia_ratio=4, friction_ratio=0.25, backlash=0.3)
exact = gearlash.simulate(servo.with_({"reference.kind": "constant", "reference.value": "1 rad"}),
                          until=printed[-1, 0]).at(printed[:, 0])
print("    time   Table II    program      exact")
for row, again, position in zip(printed, port, exact.load_position):
    print(f"{row[0]:8.2f} {row[4]:10.6f} {again[4]:10.6f} {position:10.6f}")
print(f"largest difference of the program from the exact motion: "
      f"{np.abs(port[:, 4] - exact.load_position).max():.4f} rad")

# %%
axes = pyplot.subplots(figsize=(3.5, 2.6), layout="constrained")[1]
axes.plot(exact.time, exact.load_position, linewidth=0.9, label="exact")
axes.plot(printed[:, 0], printed[:, 4], "k.", markersize=3, label="Table II")
axes.set_xlabel("time (s)")
axes.set_ylabel("load position (rad)")
axes.legend(frameon=False)
if FIGURES:
    axes.figure.savefig(FIGURES / "printout-of-1960.pdf")
