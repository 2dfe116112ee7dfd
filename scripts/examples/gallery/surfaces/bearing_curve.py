"""Bearing curves of two surfaces
==============================

What is special about a honed surface? The bearing curve gives the share of the surface above each height. Honing leaves
flat plateaus and deep valleys: the skewness Ssk is -2.6, and the core Sk is 1.1 Sq. For Gaussian heights Ssk is 0, Sk
is 2.57 Sq, and Sa is 0.80 Sq.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

size = 'size = ["1 mm", "1 mm"]\npoints = [256, 256]\nseed = 20077\n'
honed = 'plateau_rms_height = "0.15 um"\nplateau_correlation_length = "8 um"\nvalley_rms_height = "1.2 um"\n'
honed += 'valley_correlation_length = "10 um"\nmaterial_ratio = 0.8\nvalley_anisotropy = 12\nhalf_angle = "25 deg"\n'
described = {
    "Gaussian": f'kind = "gaussian"\n{size}rms_height = "0.6 um"\ncorrelation_length = "10 um"\n',
    "plateau-honed": f'kind = "plateau_honed"\n{size}{honed}',
}
parameters, surfaces = {}, {}
with tempfile.TemporaryDirectory() as directory:
    for name, text in described.items():
        Path(directory, "surface.toml").write_text(text, encoding="utf-8")
        surfaces[name] = rf.read_surface(Path(directory, "surface.toml"))
        parameters[name] = {key: one.value for key, one in rf.parameters(surfaces[name]).items()}

fig, (left, right) = plt.subplots(1, 2, figsize=(6, 3.4), layout="constrained", width_ratios=(1, 1.3))
shown = left.imshow(1e6 * surfaces["plateau-honed"].heights.T, extent=(0, 1, 0, 1), origin="lower")
fig.colorbar(shown, label="height (µm)", orientation="horizontal")
left.set(xlabel="x (mm)", ylabel="y (mm)", title="Plateau-honed")
for name, surface in surfaces.items():
    heights = np.sort(surface.heights.ravel())[::-1] / parameters[name]["Sq"]
    right.plot(100 * np.arange(1, heights.size + 1) / heights.size, heights, label=name)
right.set(xlabel="share above the height (%)", ylabel="height over Sq (1)", title="Bearing curves")
right.legend()
plt.show()
