"""Stiffness of a hydrostatic pad
==============================

How stiff is a pad that a pump feeds through a capillary or an orifice? The pressure in its recess falls as the film
grows, and so does the load. With the ratio β of the pressures of recess and pump, the stiffness is 3 W (1 - β)/h behind
a capillary and 6 W (1 - β)/(h (2 - β)) behind an orifice. The slopes of the curves are these.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

supply, viscosity, density = 2e6, 0.03, 870.0  # Pa, Pa s, kg/m³
recess = {"kind": "pocket", "x": 0.05, "length": 0.05, "extent": 0.05, "depth": 1e-3, "pressure": supply}
entries = {
    "name": "pad",
    "kind": "bearing",
    "geometry": {"shape": "parallel", "length": 0.1, "width": 0.1, "film": 42e-6},
    "lubricant": {"viscosity": viscosity, "density": density},
    "motion": {"speed": 0.5},
}
restrictors = {"capillary": {"diameter": 0.7e-3, "length": 0.05}, "orifice": {"diameter": 0.44e-3}}
films = 42e-6 * np.linspace(0.7, 2.0, 27)
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
stiffness, expected = {}, {}
for name, restrictor in restrictors.items():
    scene = rf.read_scene({**entries, "supply": [{**recess, name: restrictor}]})
    results = [rf.solve(rf.replace(scene, "geometry.film", film), model="reynolds", resolution=32) for film in films]
    loads = np.array([one["load"].value for one in results])
    ratios = np.array([one["supply_1_pressure"].value for one in results]) / supply
    closed = loads / films * (3 * (1 - ratios) if name == "capillary" else 6 * (1 - ratios) / (2 - ratios))
    stiffness[name], expected[name] = -np.gradient(loads, films, edge_order=2), closed
    ax.plot(1e6 * films, 1e-3 * loads, "o-", label=f"behind {'a capillary' if name == 'capillary' else 'an orifice'}")
ax.set(xlabel="film thickness (µm)", ylabel="load (kN)", ylim=(0, None), title="Hydrostatic pad")
ax.legend()
plt.show()
