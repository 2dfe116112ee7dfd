"""Effects in a bearing, one by one
================================

What does each effect add to a bearing? The analysis switches the effects on in turn and states what each adds, with its
uncertainty. In this short journal bearing the flow through the sides takes 83 % of the load, and rupture 2 %; viscosity
under pressure and roughness give 5 % of it back.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "gaussian", "size": ["0.5 mm", "0.5 mm"], "points": [64, 64], "seed": 7103}
surface |= {"rms_height": "1 um", "correlation_length": "40 um"}
geometry = {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "25 mm", "eccentricity": 0.75}
law = {"law": "barus", "pressure_coefficient": "20 GPa^-1"}
oil = {"viscosity": "0.05 Pa*s", "piezoviscosity": law}
entries = {"name": "journal", "kind": "bearing", "geometry": geometry, "lubricant": oil, "motion": {"speed": "4 m/s"}}
scene = rf.read_scene({**entries, "roughness": {"kind": "surface", "surface": surface}})
study = rf.effects(scene, resolution=64).at_film
names = [one.name for one in study.contributions]
plain = study.plain["load"].value  # N
added = np.array([one.on["load"].value for one in study.contributions])
errors = np.array([one.on["load"].uncertainty for one in study.contributions])
after = plain + np.cumsum(added)

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.bar(["without\neffects", *(name.replace(" ", "\n") for name in names), "all"], 0)
ax.bar([0, len(names) + 1], 1e-3 * np.array([plain, after[-1]]), color="0.6")
colors = ["C0" if change > 0 else "C3" for change in added]
ax.bar(range(1, len(names) + 1), 1e-3 * added, bottom=1e-3 * (after - added), color=colors)
for place, (top, change, error) in enumerate(zip(np.maximum(after, after - added), added, errors, strict=True), 1):
    ax.text(place, 1e-3 * top + 1, f"{1e-3 * change:+.1f} ± {1e-3 * error:.1f}", ha="center")
ax.set(ylabel="load (kN)", ylim=(0, 95), title="Load of a journal bearing, effect by effect")
plt.show()
