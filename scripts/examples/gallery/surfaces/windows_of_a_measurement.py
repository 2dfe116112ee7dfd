"""The whole surface from several windows
======================================

How well does one window describe a surface? The rms height is computed in windows of three sizes. Smaller windows
scatter more, and they lack waves that are longer than they are. The mean over the inverse of the side leads to the
whole surface, whose rms height is 1 µm here.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

import roughfilm as rf

description = """
kind = "gaussian"
size = ["1 mm", "1 mm"]
points = [512, 512]
seed = 3
rms_height = "1 um"
correlation_length = "20 um"
"""
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "surface.toml"
    path.write_text(description)
    measured = rf.read_surface(path)
recipe = {"form": "none", "smoothing": 1}
found = rf.windows(measured, size=0.25e-3, sizes=[0.17e-3, 0.125e-3], recipe=recipe)
sq = found.quantities["Sq"]

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for size, one in sq.by_size.items():
    ax.plot([1e-3 / size] * len(one.values), 1e6 * one.values, "o", color="C0", alpha=0.4)
    ax.errorbar(1e-3 / size, 1e6 * one.mean, 1e6 * one.mean_uncertainty, fmt="D", color="C3", capsize=4)
ax.vlines(1e-3 / found.size, *(1e6 * end for end in sq.scatter.interval), color="0.5", label="one window, 95 %")
ax.errorbar(0, 1e6 * sq.trend.limit, 1e6 * sq.trend.limit_uncertainty, fmt="s", color="C2", label="extrapolated")
ax.set(xlabel="1/side of the window (1/mm)", ylabel="rms height (µm)")
ax.legend()
plt.show()
