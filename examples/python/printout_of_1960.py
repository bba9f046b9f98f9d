# %% [markdown]
# # The printout of 1960
#
# N. C. New's thesis prints the motion of a servo, line by line, as Table II.
# Its program runs here again, once in double precision and once on an emulated CDC 1604.
# Give a folder as first argument to save the figure.

# %%
import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot

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

# %%
axes = pyplot.subplots(figsize=(3.5, 2.6), layout="constrained")[1]
axes.plot(port[:, 0], port[:, 4], linewidth=0.9, label="program")
axes.plot(printed[:, 0], printed[:, 4], "k.", markersize=3, label="Table II")
axes.set_xlabel("time (s)")
axes.set_ylabel("load position (rad)")
axes.legend(frameon=False)
if FIGURES:
    axes.figure.savefig(FIGURES / "printout-of-1960.pdf")
