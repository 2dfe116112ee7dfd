"""Contact area over the load
==========================

How much of ground steel touches under a load? The elastic area grows nearly in proportion to the load; Persson's
theory has 54 to 80 % of it. Steel yields at its peaks: with a hardness of 4 GPa the area is 24 to 58 % larger. If all
contact yielded, the area would be the load over the hardness.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "self_affine", "size": ["100 um", "100 um"], "points": [256, 256], "seed": 20071, "hurst": 0.8}
surface |= {"roll_off": "25 um", "cut_off": "3.125 um", "rms_slope": 0.1}
steel = {"modulus": "210 GPa", "poisson": 0.3}
entries = {
    "name": "ground steel",
    "kind": "dry_contact",
    "geometry": {"surface": surface},
    "solid": {**steel, "hardness": "4 GPa"},
    "counter": steel,
    "load": {"pressure": "100 MPa"},
}
loads = np.geomspace(1e7, 1e9, 5)  # Pa
plastic = rf.read_scene(entries)
elastic = rf.replace(plastic, "solid.hardness", None)
chosen = {"elastic": (elastic, "o-"), "persson": (elastic, "^-"), "elastic_plastic": (plastic, "s-")}
area = {}
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for model, (scene, style) in chosen.items():
    rows = rf.sweep(scene, {"load.pressure": loads}, models=[model])
    area[model] = np.array([row["area_fraction"] for row in rows])
    ax.loglog(1e-6 * loads, 100 * area[model], style, label=model)
ax.loglog(1e-6 * loads, 100 * loads / 4e9, "k:", label="load/hardness")
ax.set(xlabel="mean pressure (MPa)", ylabel="contact area (%)", title="Ground steel on steel")
ax.legend()
plt.show()
more_by_yielding = area["elastic_plastic"] / area["elastic"] - 1
persson_over_elastic = area["persson"] / area["elastic"]
