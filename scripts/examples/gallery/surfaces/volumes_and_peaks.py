"""Volumes, slopes and peaks
=========================

What do the volumes, slopes and peaks of ISO 25178-2 measure? A surface of crossed waves, cos(qx) cos(py), has closed
forms: Sdq² is (q² + p²) H²/4, the peaks are 2 to a period, and their curvature Spc is H (q² + p²)/2. The marks are the
peaks that Spd counts; the areas are the volumes of the material of the peaks (Vmp) and of the void of the valleys
(Vvv).
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

height, n = 1e-6, 256  # m
lengths = (96e-6, 64e-6)  # of a period, m
x, y = np.meshgrid(4 * lengths[0] * np.arange(n) / n, 2 * lengths[1] * np.arange(n) / n, indexing="ij")
heights = height * np.cos(2 * np.pi * x / lengths[0]) * np.cos(2 * np.pi * y / lengths[1])
surface = rf.Surface(heights=heights, spacing=(4 * lengths[0] / n, 2 * lengths[1] / n), periodic=True)
found = {name: one.value for name, one in rf.parameters(surface).items()}
profile = {name: one.value for name, one in rf.profile_parameters(heights[:, 0], spacing=surface.spacing[0]).items()}
for name in ("Sdq", "Sdr", "Spd", "Spc", "S10z", "Vmp", "Vvv"):
    print(f"{name} {found[name]:.4g}")

fig, (left, right) = plt.subplots(1, 2, figsize=(6, 3.2), layout="constrained")
shown = left.imshow(1e6 * heights.T, extent=(0, 384, 0, 128), origin="lower", aspect="auto")
peaks = np.argwhere(heights > height * (1 - 1e-9)) * surface.spacing
left.plot(*(1e6 * peaks.T), "k^", ms=4, clip_on=False)
fig.colorbar(shown, label="height (µm)", orientation="horizontal")
left.set(xlabel="x (µm)", ylabel="y (µm)")
curve = 1e6 * np.sort(heights.ravel())[::-1]
ratio = 100 * (np.arange(curve.size) + 0.5) / curve.size
right.plot(ratio, curve, "k")
for part, edge, name in ((ratio < 10, 10, "Vmp"), (ratio > 80, 80, "Vvv")):
    right.fill_between(
        ratio[part], curve[part], np.interp(edge, ratio, curve), label=f"{name} {1e9 * found[name]:.0f} nm"
    )
right.set(xlabel="share above the height (%)", ylabel="height (µm)")
right.legend()
plt.show()
