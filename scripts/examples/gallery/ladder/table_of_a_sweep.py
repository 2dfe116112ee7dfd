"""A sweep as a table
==================

Which width and depth of a groove carry most? A sweep varies any entries of a scene by any models. Its rows become a
table of pandas, whose pivot is this map at Re = 40. The best depth grows with the width, from half of the film
(15 µm) to more than the film; the widest grooves carry most.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "10 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 40}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})

varied = {"geometry.depth": np.arange(5, 46, 5) * 1e-6, "geometry.width": np.arange(1, 8) * 1e-4}
table = rf.sweep(scene, varied, models=["film_slope"]).to_dataframe()
load = table.pivot(index="geometry.depth", columns="geometry.width", values="load_per_area")
unit = table.attrs["units"]["load_per_area"]

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
filled = ax.contourf(1e3 * load.columns, 1e6 * load.index, load, levels=12)
fig.colorbar(filled, label=f"load per area ({unit})")
ax.set(xlabel="width (mm)", ylabel="depth (µm)", title="Load of a groove at Re = 40")
plt.show()
depth, width = load.stack().idxmax()
best_depths = load.idxmax()  # of each width
print(f"most, {load.to_numpy().max():.0f} {unit}, at depth {1e6 * depth:.0f} µm and width {1e3 * width:.1f} mm")
