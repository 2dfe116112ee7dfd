"""Wear between two measurements
=============================

How much material is gone between two measurements of one place? The instrument does not return to the same pixel: the
second measurement is moved by a fraction of a pixel and tilted. Both are registered by cross-correlation. Their
difference shows a scar that is shallower than the roughness.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

random = np.random.default_rng(11)
n, step = 200, 2e-6  # m
wave = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n))
waves = np.fft.rfft2(random.normal(size=(n, n))) * np.where(wave < 0.15, np.maximum(wave, 0.03) ** -1.8, 0)
waves /= np.fft.irfft2(waves).std()
moved = np.exp(-2j * np.pi * (np.fft.fftfreq(n)[:, None] * 4.3 + np.fft.rfftfreq(n) * -2.6))  # pixels
x, y = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
scar = 0.6e-6 * np.clip(1 - ((x - 105) / 35) ** 2 - ((y - 95) / 25) ** 2, 0, None)  # m
noise = 0.02e-6 * random.normal(size=(2, n, n))
inner = np.s_[10:-10, 10:-10]
before = rf.Surface(heights=(1e-6 * np.fft.irfft2(waves) + noise[0])[inner], spacing=(step, step))
after = (1e-6 * np.fft.irfft2(waves * moved) + noise[1] - scar + 2e-9 * x)[inner]
worn = rf.combine(before, rf.Surface(heights=after, spacing=(step, step)))
gone = worn.quantities["worn_volume_per_area"]
shift = [worn.quantities[f"shift_{axis}"] for axis in "xy"]
true_volume = np.pi * 35 * 25 * 0.6e-6 / 2 / worn.surface.heights.size  # m

fig, axes = plt.subplots(1, 2, figsize=(6, 3.7), sharey=True, layout="constrained")
for ax, shown, title in zip(axes, (worn.second, worn.surface), ("After", "Before − after"), strict=True):
    size = [1e6 * length for length in shown.size]
    maps = ax.imshow(1e6 * shown.heights.T, extent=(0, size[0], 0, size[1]), origin="lower")
    fig.colorbar(maps, ax=ax, label="height (µm)", orientation="horizontal")
    ax.set(xlabel="x (µm)", title=title)
axes[0].set_ylabel("y (µm)")
plt.show()
