"""Flow factors of a height map over the mean gap, with their uncertainty."""

import numpy as np

import roughfilm as rf

x, y = np.meshgrid(np.arange(96) / 96, np.arange(64) / 64, indexing="ij")
heights = 1e-6 * (np.cos(2 * np.pi * x) + 0.5 * np.cos(4 * np.pi * y))
for gap in (2e-6, 4e-6, 8e-6):
    factors = rf.flow_factors(heights, spacing=1e-6, gap=gap)
    for name in ("A11", "A22", "B1"):
        print(f"{1e6 * gap:.0f} µm: {name} = {factors[name].value:.4f} ± {factors[name].uncertainty:.0e}")
