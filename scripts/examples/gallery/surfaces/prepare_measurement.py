"""A periodic cell of a measurement
================================

How does a measurement become a periodic surface? It is tilted and curved, lacks points and does not fit to itself at
its edges. Preparation subtracts the form, fills the points and joins the edges along seams through the overlap of both
ends, by which the cell is shorter. In the middle the heights stay those of the measurement without its form.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

random = np.random.default_rng(7)
n = 160
wave = np.fft.fftfreq(n + 40)[:, None] ** 2 + np.fft.fftfreq(n + 40) ** 2
noise = np.fft.ifft2(np.fft.fft2(random.normal(size=(n + 40, n + 40))) * np.exp(-400 * wave)).real
rough = 0.5e-6 * noise[:n, :n] / noise.std()  # m, not periodic
x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing="ij")
invalid = random.random((n, n)) < 0.02
heights = np.where(invalid, 0, rough + 3e-6 * x + 1e-6 * y + 2e-6 * x**2)
measured = rf.Surface(heights=heights, spacing=(2e-6, 2e-6), invalid=invalid)
recipe = {"edges": {"direction": "both"}, "smoothing": 1, "grid": {"points": "kept"}}
prepared = rf.prepare(measured, recipe)
cell, window = prepared.surface.heights, prepared.record["window"].values()
part = tuple(slice(i, i + n) for i, n in zip(*window, strict=True))  # of the measurement

fig, axes = plt.subplots(1, 2, figsize=(6, 3.7), sharey=True, layout="constrained")
moved = np.roll(cell, [-(count // 2) for count in cell.shape], axis=(0, 1))  # its four corners meet in the middle
shown = np.ma.masked_where(invalid, measured.heights)
for ax, heights, title in zip(axes, (shown, moved), ("Measured", "Periodic cell, moved by half"), strict=True):
    maps = ax.imshow(1e6 * heights.T, extent=(0, 2 * len(heights), 0, 2 * heights.shape[1]), origin="lower")
    fig.colorbar(maps, ax=ax, label="height (µm)", orientation="horizontal")
    ax.set(xlabel="x (µm)", title=title)
axes[0].set_ylabel("y (µm)")
plt.show()
powers = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)
form = powers @ np.linalg.lstsq(powers[~invalid], measured.heights[~invalid], rcond=None)[0]
changed = np.where(invalid[part], 0, cell - (measured.heights - form)[part])
in_the_middle, anywhere = np.abs(changed[40:-40, 40:-40]).max(), np.abs(changed).max()  # m
