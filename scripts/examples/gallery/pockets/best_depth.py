"""Best depth of a groove
======================

Which depth of a groove carries most, and does the width matter? The load over the depth has one maximum. A wider groove
has a deeper optimum: 18 µm for a width of 0.15 mm and 25 µm for 0.45 mm, at Re = 40 and a film of 30 µm.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "10 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 40}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})

depths = np.arange(2, 41, 2) * 1e-6  # m
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
best, most = [], []
for width in (0.15e-3, 0.3e-3, 0.45e-3):
    rows = rf.sweep(rf.replace(scene, "geometry.width", width), {"geometry.depth": depths}, models=["film_slope"])
    load = np.array([row["load_per_area"] for row in rows])
    (line,) = ax.plot(1e6 * depths, 1e-3 * load, label=f"{1e3 * width:.2f} mm wide")
    top = int(load.argmax())
    parabola = np.polynomial.Polynomial.fit(depths[top - 1 : top + 2], load[top - 1 : top + 2], 2)
    best.append(float(parabola.deriv().roots()[0].real))
    most.append(float(parabola(best[-1])))
    ax.plot(1e6 * best[-1], 1e-3 * most[-1], "o", color=line.get_color())
ax.set(xlabel="depth (µm)", ylabel="load per area (kPa)", ylim=(0, None), title="Load over depth at Re = 40")
ax.legend()
plt.show()
print("best depths (µm):", np.round(1e6 * np.array(best), 1), " loads (kPa):", np.round(1e-3 * np.array(most), 2))
