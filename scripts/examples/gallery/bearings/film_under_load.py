"""Film of a journal bearing under load
====================================

How thin does the film become under a load? With a load in the scene each model seeks the eccentricity that carries it.
The film at 5 kN is 10.3 µm. A hundred times the load makes the film 12.5 times thinner. The points of Butenschön's
table (1976) for this bearing lie on the curve.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

geometry = {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "50 mm"}
entries = {"name": "journal", "kind": "bearing", "geometry": geometry, "load": {"force": "5 kN"}}
scene = rf.read_scene({**entries, "lubricant": {"viscosity": "0.02 Pa*s"}, "motion": {"speed": "2 m/s"}})

# Eccentricity and So = F ψ²/(B D η ω) of Butenschön (1976) for B = D
published = np.array([[0.1, 0.1196], [0.4, 0.6108], [0.6, 1.3146], [0.8, 3.5663], [0.9, 8.4352]])
forces = np.geomspace(0.5e3, 50e3, 9)  # N
results = [
    rf.solve(rf.replace(scene, "load.force", force), model="reynolds_cavitating", resolution=96) for force in forces
]
films = np.array([one["film_min"].value for one in results])
errors = np.array([one["film_min"].uncertainty for one in results])
friction = [one["friction_coefficient"].value for one in results]

fig, (top, bottom) = plt.subplots(2, figsize=(6, 5.5), sharex=True, layout="constrained")
top.errorbar(1e-3 * forces, 1e6 * films, 1e6 * errors, fmt="o-", label="roughfilm")
unit = 0.05 * 0.05 * 0.02 * 80 / 1e-6  # B D η ω/ψ² in N
top.plot(1e-3 * unit * published[:, 1], 25 * (1 - published[:, 0]), "x", color="C3", markersize=9, label="Butenschön")
top.set(xscale="log", yscale="log", ylabel="least film (µm)", title="Journal bearing under load")
top.set_yticks([2, 5, 10, 20], ["2", "5", "10", "20"])
top.minorticks_off()
top.legend()
bottom.plot(1e-3 * forces, friction, "o-")
bottom.set(yscale="log", xlabel="load (kN)", ylabel="friction coefficient (1)")
plt.show()
