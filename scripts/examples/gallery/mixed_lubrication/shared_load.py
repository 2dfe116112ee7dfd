"""Who carries the load of a pad
=============================

When does a rough pad touch? The model mixed adds the pressures of film and asperities over the distance of the mean
planes. From three rms heights on the film carries all, and the friction is least; at 1.5 the asperities carry a third.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "gaussian", "size": ["0.5 mm", "0.5 mm"], "points": [64, 64], "seed": 7103}
surface |= {"rms_height": "1 um", "correlation_length": "40 um"}
entries = {
    "name": "pad",
    "kind": "bearing",
    "geometry": {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "3 um", "rise": "2 um"},
    "lubricant": {"viscosity": "0.05 Pa*s"},
    "motion": {"speed": "1 m/s"},
    "roughness": {"kind": "surface", "surface": surface},
    "asperities": {"friction": 0.12, "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "3 GPa"}},
}
scene = rf.read_scene(entries)
films = np.array([1.5, 2, 2.5, 3, 3.5, 4, 5, 6]) * 1e-6  # m
results = [rf.solve(rf.replace(scene, "geometry.film", film), model="mixed", resolution=48) for film in films]
names = ("load", "film_load", "contact_load", "friction_coefficient")
load, by_film, by_contact, friction = (np.array([one[name].value for one in results]) for name in names)

fig, (top, bottom) = plt.subplots(2, figsize=(6, 5.5), sharex=True, layout="constrained")
top.semilogy(1e6 * films, 1e-3 * load, "k-", label="both")
top.semilogy(1e6 * films, 1e-3 * by_film, "o--", label="film")
top.semilogy(1e6 * films[by_contact > 0], 1e-3 * by_contact[by_contact > 0], "s--", label="asperities")
top.set(ylabel="load (kN)", title="Pad with an rms height of 1 µm")
top.legend()
bottom.plot(1e6 * films, friction, "o-")
bottom.set(xlabel="distance of the mean planes (µm)", ylabel="friction coefficient (1)", ylim=(0, None))
plt.show()
share = by_contact / load
