# %% [markdown]
# # A production run
#
# The numbers of the drive file have tolerances. How many samples hunt, and how much?
# Give a folder as first argument to save the figure.

# %%
import sys
from pathlib import Path

import gearlash
from gearlash import plot

EXAMPLES = Path(__file__).resolve().parents[1]
FIGURES = Path(sys.argv[1]) if len(sys.argv) > 1 else None

# %%
drive = gearlash.Drive.from_toml(EXAMPLES / "toleranced.toml")
study = gearlash.tolerance(drive)
print(f"{study.hunting.value:.4f} of the samples hunt")

# %% [markdown]
# The histogram counts the samples that hunt, by the amplitude of the load.

# %%
if study.histogram.counts:
    axes = plot.distribution(study, unit="mrad")
    if FIGURES:
        axes.figure.savefig(FIGURES / "tolerance-study.png", dpi=300)
