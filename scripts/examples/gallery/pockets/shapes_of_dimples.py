"""Shapes of dimples
=================

Which shapes may a dimple have? Seven, one cell of each. All but the groove may be turned and stretched; a flat floor
ends in a ramp of the width ``edge``, and a map takes depths from a file or from rows of numbers. The maps show the film
thickness, which every result in plan has.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

round_, flat = {"width": "0.5 mm", "depth": "10 um"}, {"width": "0.5 mm", "depth": "10 um", "edge": "50 um"}
s = np.linspace(-1, 1, 41)
waves = 5e-6 * (1 - s[:, None] ** 2) * (1 - s**2) * (1 - np.cos(3 * np.pi * s)) / 0.8  # m
shapes = {
    "spherical": round_,
    "ellipsoidal": {**round_, "breadth": "0.8 mm", "rotation": "30 deg"},
    "conical": round_,
    "box": {**flat, "breadth": "0.7 mm", "rotation": "30 deg"},
    "chevron": {**flat, "width": "0.25 mm", "breadth": "0.8 mm", "angle": "45 deg"},
    "groove": round_,
    "points": {"width": "0.7 mm", "breadth": "0.7 mm", "points": waves.tolist()},
}
cell = {"length": "1 mm", "breadth": "1 mm", "film": "20 um"}
base = {"name": "shapes", "kind": "pocket", "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}}
fig, panels = plt.subplots(2, 4, figsize=(6, 3.6), layout="constrained", sharex=True, sharey=True)
covered = {}
for ax, (shape, keys) in zip(panels.flat, shapes.items(), strict=False):
    geometry = {**cell, "dimples": [{"shape": shape, **keys}]}
    scene = rf.read_scene({**base, "geometry": geometry, "motion": {"speed": "1 m/s"}})
    fields, covered[shape] = rf.solve(scene, model="reynolds", resolution=120).fields, scene.covered
    x, y, h = (fields[name].values for name in ("x", "y", "film_thickness"))
    colors = ax.pcolormesh(1e3 * x, 1e3 * y, 1e6 * h, cmap="cividis", vmin=20, vmax=30)
    ax.set(title=f'"{shape}"', xlabel="along (mm)", ylabel="across (mm)", aspect="equal")
    ax.label_outer()
panels.flat[-1].set_axis_off()
fig.colorbar(colors, ax=panels, label="film thickness (µm)")
plt.show()
