"""Where the lowest point of a groove should be
============================================

Is a groove better if its lowest point lies upstream? Without inertia a groove and its mirror image carry opposite
loads. At Re = 40 inertia adds nearly the same load to both. A groove with its lowest point 0.15 mm upstream carries
5.0 kPa, eleven times as much as its mirror image.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "splined", "width": "0.5 mm", "depth": "15 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 40}
scene = rf.read_scene({"name": "splined", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})

shifts = np.linspace(-0.15e-3, 0.15e-3, 13)  # m, from the middle of the groove along the sliding
rows = rf.sweep(scene, {"geometry.shift": shifts}, models=["reynolds", "film_slope"])
load = {
    name: np.array([row["load_per_area"] for row in rows if row["model"] == name])
    for name in ("reynolds", "film_slope")
}

fig, (left, right) = plt.subplots(2, figsize=(6, 5.5), layout="constrained")
fig.suptitle("Grooves 15 µm deep, Re = 40")
for shift in (-0.15e-3, 0.0, 0.15e-3):
    fields = rf.solve(rf.replace(scene, "geometry.shift", shift), model="film_slope").fields
    gap = fields["film_thickness"].values
    left.plot(1e3 * fields["position"].values, -1e6 * gap, label=f"shift {1e3 * shift:+.2f} mm")
left.set(xlabel="along the sliding (mm)", ylabel="lower wall (µm)")
left.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1))
for name, values in load.items():
    right.plot(1e3 * shifts, 1e-3 * values, "o-", label=name)
right.axhline(0, color="0.7", linewidth=0.8)
right.set(xlabel="shift of the lowest point (mm)", ylabel="load per area (kPa)")
right.legend()
plt.show()
best_shift = float(shifts[load["film_slope"].argmax()])
