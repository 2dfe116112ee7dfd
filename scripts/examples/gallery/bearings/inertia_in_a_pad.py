"""Inertia in a pad with grooves near its inlet
============================================

Grooves across the inlet half of a parallel pad carry load by the Reynolds equation. Does inertia add to it? The thin
film with inertia and slope (``film_slope``) answers at a few speeds. Up to Re/λ = 3, with the Reynolds number Re of
the film and the length λ of a groove over its depth, inertia changes the load by less than 1 %. Beyond it takes load,
a fifth at Re/λ = 25: the flow no longer follows the walls of the grooves, which pump less in front of the smooth half.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

film, depth, aspect, viscosity, density = 20e-6, 20e-6, 16, 0.01, 1000.0  # m, m, 1, Pa s, kg/m³
groove = aspect * depth
grooves = {"length": groove, "depth": depth, "start": groove / 2, "pitch": 2 * groove, "columns": 5}
entries = {
    "name": "grooved pad",
    "kind": "bearing",
    "geometry": {"shape": "parallel", "length": 20 * groove, "film": film, "texture": grooves},
    "lubricant": {"viscosity": viscosity, "density": density, "cavitation_pressure": "-1 GPa"},
    "motion": {"speed": "1 m/s"},
}
numbers = np.array([1, 5, 20, 50, 100, 200, 400])  # Reynolds numbers ρ u h/η
scenes = [rf.read_scene(entries | {"motion": {"speed": n * viscosity / (density * film)}}) for n in numbers]
load = {m: np.array([rf.solve(s, model=m)["load"].value for s in scenes]) for m in ("reynolds", "film", "film_slope")}
change = {model: load[model] / load["reynolds"] - 1 for model in ("film", "film_slope")}

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for model, values in change.items():
    ax.semilogx(numbers / aspect, 100 * values, "o-", label=model)
ax.axhline(0, color="black", linewidth=0.8)
ax.set(xlabel="Re/λ (1)", ylabel="load against Reynolds' equation (%)", title="Inertia in a pad with grooves")
ax.legend()
plt.show()
