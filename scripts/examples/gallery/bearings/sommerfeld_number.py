"""Sommerfeld number of journal bearings
=====================================

How far is a shaft from the middle of its bearing? The Sommerfeld number answers for all journal bearings with one ratio
of width to diameter. The points of Raimondi and Boyd (1958) are within 1.4 % of our curves. Ocvirk's closed form
(dashed) holds for short bearings and small eccentricities.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

published = {  # Sommerfeld number by width over diameter, at the eccentricities 0.2, 0.4, 0.6 and 0.8
    1.0: [0.631, 0.264, 0.121, 0.0446],
    0.5: [2.03, 0.779, 0.319, 0.0923],
    0.25: [7.57, 2.83, 1.07, 0.261],
}
geometry = {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "50 mm", "eccentricity": 0.5}
entries = {"name": "journal", "kind": "bearing", "geometry": geometry}
scene = rf.read_scene({**entries, "lubricant": {"viscosity": "0.02 Pa*s"}, "motion": {"speed": "2 m/s"}})

eccentricities = np.array([0.1, 0.2, 0.4, 0.6, 0.8, 0.9])
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ours = {}
for ratio, points in published.items():
    wide = rf.replace(scene, "geometry.width", 0.05 * ratio)
    rows = rf.sweep(wide, {"geometry.eccentricity": eccentricities}, models=["reynolds_cavitating"])
    ours[ratio] = np.array([row["sommerfeld_number"] for row in rows])
    (line,) = ax.semilogy(eccentricities, ours[ratio], label=f"width {ratio:g} of the diameter")
    ax.plot([0.2, 0.4, 0.6, 0.8], points, "o", color=line.get_color())
e = np.linspace(0.1, 0.9, 100)
ocvirk = (1 - e**2) ** 2 / (0.25**2 * np.pi * e * np.sqrt(np.pi**2 * (1 - e**2) + 16 * e**2))
ax.plot(e, ocvirk, "k--", linewidth=1, label="Ocvirk, width 0.25")
ax.set(xlabel="eccentricity over clearance (1)", ylabel="Sommerfeld number (1)", title="Journal bearing")
ax.legend(loc="lower left")
plt.show()
largest_difference = max(float(np.max(np.abs(ours[r][1:5] / published[r] - 1))) for r in published)
print(f"largest difference from Raimondi and Boyd: {largest_difference:.1%}")
