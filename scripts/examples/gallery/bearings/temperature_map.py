"""Temperature map of a journal bearing
====================================

Where is the film of a journal bearing hottest, and how much do the walls cool it? The maps show the mean temperature
across the unwrapped film, which is supplied at 45 °C at the widest place and at its sides. Between walls that take no
heat the oil heats up as it passes, and is hottest at the end. A shaft has one temperature: it takes heat from the hot
part and gives it back at the inlet. With it and a steel shell at 45 °C outside the film is 24 K cooler, and hottest at
the narrowest place (180°).
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
shell = {"kind": "conducting", "thickness": "10 mm", "conductivity": "50 W/(m*K)"}
walls = {"walls take no heat": {}, "turning shaft, steel shell": {"sliding_wall": "turning", "fixed_wall": shell}}
fig, axes = plt.subplots(2, figsize=(6, 5), sharex=True, layout="constrained")
results = {}
for ax, (name, heat) in zip(axes, walls.items(), strict=True):
    result = results[name] = rf.solve(rf.read_scene(entries | {"heat": heat}), model="across", resolution=48)
    angle, y = np.degrees(result.fields["x"].values / 0.025), 1e3 * result.fields["y"].values
    warmth = result.fields["temperature"].values  # °C
    filled = ax.contourf(angle, y, warmth, levels=10, cmap="YlOrRd")
    fig.colorbar(filled, ax=ax, label="temperature (°C)")
    ax.set(ylabel="across (mm)", title=f"{name}: load {result['load']}")
axes[1].set(xlabel="angle from the widest place (°)", xticks=range(0, 361, 60))
plt.show()

for name, result in results.items():
    taken = result["heat_to_fixed_wall"].value / result["heat_generated"].value
    print(f"{name}: highest temperature {result['temperature_max']}, {taken:.0%} of the heat to the shell")
