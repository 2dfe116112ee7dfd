"""One temperature or a field
==========================

When is one temperature for the whole film enough? Bearing standards balance the friction of a journal bearing with the
heat that its oil takes away, at the mean of the temperatures in and out. At 6000 rpm the film then carries 39 % less
than at the temperature of the supply. But the oil is hotter where the film is thin: with the temperature of each place
it carries 54 % less. That it varies across the film too hardly matters here, as the walls take no heat.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

entries = {
    "name": "journal",
    "kind": "bearing",
    "geometry": {"shape": "journal", "radius": "25 mm", "clearance": "40 um", "width": "25 mm", "eccentricity": 0.7},
    "lubricant": {"oil": "ISO VG 32", "temperature": "45 degC"},
    "motion": {"speed": "3000 rpm"},
}
scene = rf.read_scene(entries)
turns = np.array([100, 300, 1000, 3000, 6000])  # rpm
models = {
    "reynolds_cavitating": "temperature of the supply",
    "heat_balance": "one temperature",
    "adiabatic": "temperature over the film",
    "across": "and across it",
}
loads, found = {}, {}
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for (model, name), style in zip(models.items(), ("k--", "o-", "s-", "x:"), strict=True):
    cases = [rf.replace(scene, {"motion.speed": f"{n} rpm"}) for n in turns]
    found[model] = [rf.solve(case, model=model, resolution=24) for case in cases]
    loads[model] = np.array([one["load"].value for one in found[model]])
    ax.plot(turns, loads[model] / loads["reynolds_cavitating"], style, label=name)
ax.set(xscale="log", ylim=(0, 1.1), xlabel="speed (rpm)", ylabel="load over that at 45 °C (-)")
ax.legend(title="journal bearing, eccentricity 0.7")
plt.show()
