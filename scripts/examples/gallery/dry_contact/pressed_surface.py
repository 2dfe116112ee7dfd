"""Pressure and gap of a pressed surface
=====================================

What happens between the peaks of a pressed surface? At a tenth of the hardness it touches on 10.3 % of its area, in
many islands, and nearly all of them yield. Between them remains a gap. The mean of the pressure is the load.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "self_affine", "size": ["100 um", "100 um"], "points": [256, 256], "seed": 20071, "hurst": 0.8}
surface |= {"roll_off": "25 um", "cut_off": "3.125 um", "rms_slope": 0.1}
entries = {
    "name": "ground steel",
    "kind": "dry_contact",
    "geometry": {"surface": surface},
    "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "4 GPa"},
    "load": {"pressure": "400 MPa"},
}
result = rf.solve(rf.read_scene(entries), model="elastic_plastic")
pressure, gap = result.fields["pressure"].values, result.fields["gap"].values
touching, yielding = result["area_fraction"], result["plastic_fraction"]

fig, (left, right) = plt.subplots(1, 2, figsize=(6, 3.6), sharey=True, layout="constrained")
shown = np.ma.masked_where(pressure == 0, 1e-9 * pressure)
maps = left.imshow(shown.T, origin="lower", extent=(0, 100, 0, 100), cmap="magma_r", vmin=0)
fig.colorbar(maps, ax=left, label="pressure (GPa)", orientation="horizontal")
maps = right.imshow(1e6 * gap.T, origin="lower", extent=(0, 100, 0, 100), cmap="viridis")
fig.colorbar(maps, ax=right, label="gap (µm)", orientation="horizontal")
left.set(xlabel="x (µm)", ylabel="y (µm)", title="Pressure of the islands")
right.set(xlabel="x (µm)", title="Gap between them")
plt.show()
mean_pressure, largest = float(pressure.mean()), float(pressure.max())
print(f"contact area {touching}, of it plastic {yielding}, mean pressure {mean_pressure:.4g} Pa")
