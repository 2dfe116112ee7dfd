"""Pivot of a tilting pad
======================

Where should a pad be pivoted? The pad tilts until its centre of pressure is at its pivot. Of infinitely wide flat pads
the position has a closed form (Raimondi and Boyd 1955); square pads take the side flow into account. The film under
2 MPa is thickest with the pivot at 0.6 of the length of the square pad, and vanishes towards the middle of both pads.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

length, pivots = 0.04, np.array([0.51, 0.54, 0.57, 0.6, 0.63, 0.66, 0.7])  # m, fraction of the length
pad = {"shape": "pivoted", "length": length, "pivot": 0.6}
entries = {"name": "pad", "kind": "bearing", "geometry": pad, "lubricant": {"viscosity": 0.03}, "motion": {"speed": 10}}
films, ratios = {}, {}
for name, width in (("infinitely wide", {}), ("square", {"width": length})):
    scene = rf.read_scene(entries | {"geometry": pad | width, "load": {"pressure": 2e6}})
    rows = [
        rf.solve(rf.replace(scene, "geometry.pivot", float(at)), model="reynolds_cavitating", resolution=64)
        for at in pivots
    ]
    films[name] = np.array([row["film_min"].value for row in rows])
    slope = np.array([row["slope_x"].value for row in rows])
    ratios[name] = 1 - slope * length / films[name]

a = np.linspace(1.05, 12, 200)  # film at the inlet over that at the outlet
centre = ((a**2 + 2 * a) * np.log(a) - (a - 1) * (5 * a + 1) / 2) / ((a**2 - 1) * np.log(a) - 2 * (a - 1) ** 2)
fig, (left, right) = plt.subplots(1, 2, figsize=(6, 3.5), layout="constrained")
left.plot(centre, a, label="closed form")
for name in films:
    left.plot(pivots, ratios[name], "o", markersize=4, label=name)
    right.plot(pivots, 1e6 * films[name], "o-", markersize=4, label=name)
left.set(xlabel="pivot over the length (1)", ylabel="film ratio, inlet over outlet (1)", title="Tilt")
right.set(xlabel="pivot over the length (1)", ylabel="least film (µm)", title="Film under 2 MPa")
left.legend(), right.legend()
plt.show()
