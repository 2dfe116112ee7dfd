"""Inertia and cavitation in one groove
====================================

What do inertia and cavitation each do to the load of a groove? Without both, a symmetric groove in the middle of its
period carries nothing. Inertia lifts the wall, in proportion to the square of the speed at first. From 7.8 m/s the film
ruptures behind the upstream edge, and liquid is missing where the gap narrows: cavitation pulls the wall down. The two
oppose each other, with +38 and −32 kPa at 50 m/s, but do not add up: inertia acts only on the film that is left.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

groove = {"length": "2 mm", "film": "20 um", "profile": "cylindrical", "width": "0.8 mm", "depth": "15 um"}
liquid = {"viscosity": "0.02 Pa*s", "density": "870 kg/m^3"}
motion = {"speed": "1 m/s"}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})

speeds = np.array([2, 5, 7, 8, 10, 15, 20, 30, 40, 50])
models = {"reynolds": "neither", "film_slope": "inertia and slope", "reynolds_cavitating": "cavitation"}
rows = rf.sweep(scene, {"motion.speed": [f"{speed} m/s" for speed in speeds]}, models=list(models))
load = {name: np.array([row["load_per_area"] for row in rows if row["model"] == name]) / 1e3 for name in models}
ruptured = np.array([row["cavitated_fraction"] for row in rows if row["model"] == "reynolds_cavitating"])

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for (name, effect), style in zip(models.items(), ["s-", "o-", "^-"], strict=True):
    ax.plot(speeds, load[name], style, markersize=5, label=effect)
ax.set(xlabel="sliding speed (m/s)", ylabel="load per area (kPa)")
ax.set_title("Load of a groove 0.8 mm wide and 15 µm deep")
ax.legend()
plt.show()

inertia, cavitation = load["film_slope"][-1], load["reynolds_cavitating"][-1]
print(f"At 50 m/s: inertia {inertia:+.1f} kPa, cavitation {cavitation:+.1f} kPa over {ruptured[-1]:.0%} of the period.")
