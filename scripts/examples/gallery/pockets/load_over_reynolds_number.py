"""Load of a groove over the Reynolds number
=========================================

How does the load of a groove in a parallel film grow with the Reynolds number? A film without inertia carries nothing,
because the pressure before the groove is the mirror image of that behind it. Inertia adds a load in proportion to Re at
first; at Re = 160 the linear law is 7.1 % too high. The slope of the wall changes the load by 0.5 %.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "7.5 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 1}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})

numbers = np.array([1, 2, 5, 10, 20, 40, 80, 160])
models = ["reynolds", "inertial_reynolds", "film", "film_slope"]
rows = rf.sweep(scene, {"motion.reynolds_number": numbers}, models=models)
load = {name: np.array([row["load_plus"] for row in rows if row["model"] == name]) for name in models}

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for name, style in zip(models, ["s-", "^-", "o-", "--"], strict=True):
    ax.plot(numbers, load[name], style, markersize=5, label=name)
ax.set(xscale="log", xlabel="Reynolds number (1)", ylabel="dimensionless load (1)")
ax.set_title("Load of a cylindrical groove, 7.5 µm deep")
ax.legend()
plt.show()

linear_too_high = load["inertial_reynolds"][-1] / load["film"][-1] - 1
by_slope = abs(load["film_slope"][-1] / load["film"][-1] - 1)
print(f"At Re = 160 the linear law is {linear_too_high:.1%} too high; the slope changes the load by {by_slope:.1%}.")
