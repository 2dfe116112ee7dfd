"""Vortex in a deep groove
=======================

From which depth on does the liquid in a groove flow backwards? Without inertia it does where the gap exceeds
1.5 <h⁻²>/<h⁻³>, which is a depth of 17.1 µm here; the models find it between 17.0 and 17.5 µm. At 30 µm the back-flow
(blue) fills half of the groove, and reaches 3.0 % of the sliding speed.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "30 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 40}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})

depths = np.arange(10, 30.5, 0.5) * 1e-6  # m
rows = rf.sweep(scene, {"geometry.depth": depths}, models=["reynolds", "film"])
backflow = {name: np.array([row["backflow"] for row in rows if row["model"] == name]) for name in ("reynolds", "film")}
onset = {name: float(depths[values > 0][0]) for name, values in backflow.items()}

fields = rf.solve(scene, model="film").fields
corners, velocity = 1e6 * fields["vertices"].values, fields["cell_velocity"].values[..., 0] / scene.speed
fig, ax = plt.subplots(figsize=(6, 3.2), layout="constrained")
x, z = 1e-3 * corners[..., 0], corners[..., 1]
colors = ax.pcolormesh(x, z, velocity, cmap="RdBu_r", vmin=-0.05, vmax=0.05)
ax.set(xlabel="along the sliding (mm)", ylabel="height (µm)", title="Flow in a groove, Re = 40")
fig.colorbar(colors, label="velocity over\nsliding speed (1)", extend="both")
plt.show()

heights = np.diff(corners[..., 1] * 1e-6, axis=1)
flow = (velocity * scene.speed * 0.5 * (heights[1:] + heights[:-1])).sum(axis=1)  # m²/s, through each section
largest = float(-velocity.min())
print(f"back-flow from {1e6 * onset['reynolds']:.1f} µm (reynolds) and {1e6 * onset['film']:.1f} µm (film)")
