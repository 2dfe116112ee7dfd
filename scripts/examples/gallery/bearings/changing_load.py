"""Journal under a load that turns
===============================

Which path does a shaft follow whose load turns, as that of an unbalance or of a crank? The load turns at half of the
speed of the shaft: the wedge does not carry then, and only the squeezing of the film keeps the shaft from the bore. A
load of the same size that stands still leaves a thicker film. The grid is coarse.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

entries = {
    "name": "turning load",
    "kind": "bearing",
    "geometry": {"shape": "lobes", "radius": "25 mm", "clearance": "25 um", "width": "25 mm"},
    "lubricant": {"viscosity": "10 mPa*s", "cavitation_pressure": "-0.1 MPa"},
}
fig, axes = plt.subplots(figsize=(6, 5), layout="constrained")
least = {}
for name, turns in (("standing", 0), ("half speed", 1)):
    table = {"time": ["0 ms", "20 ms", "40 ms"], "load": ["1 kN"] * 3, "period": "40 ms"}
    table["angle"] = [f"{angle} deg" for angle in np.array([-90, 90, 270]) * turns - 90 * (1 - turns)]
    scene = rf.read_scene({**entries, "motion": {"speed": "3000 rpm", "over_time": table}})
    march = rf.march(scene, end=0.12, cells=(24, 8), uncertainty=False)
    late = march.time > march.first
    axes.plot(march["eccentricity_x"][late], march["eccentricity_y"][late], ".-", label=name)
    least[name] = march.quantities["film_min"].value
angle = np.linspace(0, 2 * np.pi, 200)
axes.plot(np.cos(angle), np.sin(angle), "k", linewidth=0.8)
axes.set(xlabel="x over the clearance (1)", ylabel="y over the clearance (1)", aspect="equal")
axes.legend()
plt.show()
print("least film (µm):", {name: round(1e6 * film, 2) for name, film in least.items()})
