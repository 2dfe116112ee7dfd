"""Best inclination of a slider
============================

How much should a slider be inclined? The load of an infinitely wide, plane slider over the rise of its film has a
closed form (Rayleigh 1918) with its maximum at h1/h2 = 2.19. The solver agrees with it within its own uncertainty.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

film, length, speed, viscosity = 20e-6, 0.05, 5.0, 0.03  # m, m, m/s, Pa s
entries = {
    "name": "slider",
    "kind": "bearing",
    "geometry": {"shape": "linear", "length": length, "film": film, "rise": film},
    "lubricant": {"viscosity": viscosity},
    "motion": {"speed": speed},
}
scene = rf.read_scene(entries)
rises = film * np.linspace(0.2, 3.0, 29)
rows = rf.sweep(scene, {"geometry.rise": rises}, models=["reynolds"])
load = np.array([row["load_per_width"] for row in rows])
uncertainty = np.array([row["load_per_width_uncertainty"] for row in rows])

a = 1 + np.linspace(0.2, 3.0, 200)  # film at the inlet over that at the outlet
exact = 6 * viscosity * speed * (length / film) ** 2 / (a - 1) ** 2 * (np.log(a) - 2 * (a - 1) / (a + 1))
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.plot(a, 1e-3 * exact, label="closed form")
ax.plot(1 + rises / film, 1e-3 * load, "o", markersize=4, label="reynolds")
ax.set(xlabel="film at the inlet over film at the outlet (1)", ylabel="load per width (kN/m)", title="Plane slider")
ax.legend()
plt.show()
top = int(load.argmax())
parabola = np.polynomial.Polynomial.fit(1 + rises[top - 1 : top + 2] / film, load[top - 1 : top + 2], 2)
best_ratio, best_load = float(parabola.deriv().roots()[0].real), float(load.max())
print(f"best h1/h2 = {best_ratio:.3f}, load {1e-3 * best_load:.1f} kN/m")
