"""A surface from a profile
========================

A stylus measures a line, contact and flow need a surface. The spectrum of an isotropic surface follows from that of its
profiles. Here a profile of 5 mm with a correlation length of 10 µm gives a surface with the rms height and the rms
slope of the surface on which it was measured.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

n, spacing, rms, length = 5000, 1e-6, 1e-6, 10e-6  # m
power = np.exp(-((np.pi * np.fft.rfftfreq(n, spacing) * length) ** 2))  # of the autocorrelation exp(-(r/length)²)
line = np.fft.irfft(np.sqrt(power) * np.fft.rfft(np.random.default_rng(1).standard_normal(n)))
line *= rms / line.std()

with tempfile.TemporaryDirectory() as folder:
    np.save(Path(folder) / "line.npy", line)
    profile = rf.read_profile(Path(folder) / "line.npy", spacing=spacing)
surface = rf.fit_profile(profile)
sq = surface.heights.std()
slope = np.diff(surface.heights, axis=0).std() / spacing

fig, axes = plt.subplots(1, 2, figsize=(6, 3), layout="constrained")
axes[0].plot(1e3 * spacing * np.arange(300), 1e6 * profile.heights[:300])
axes[0].set(xlabel="x (mm)", ylabel="height of the profile (µm)")
extent = [0, 1e3 * spacing * surface.shape[0], 0, 1e3 * spacing * surface.shape[1]]
image = axes[1].imshow(1e6 * surface.heights.T, origin="lower", extent=extent)
axes[1].set(xlabel="x (mm)", ylabel="y (mm)", box_aspect=1)
fig.colorbar(image, ax=axes[1], label="height of the surface (µm)")
fig.suptitle(f"surface: rms height {1e6 * sq:.2f} µm, rms slope {slope:.3f}")
plt.show()
