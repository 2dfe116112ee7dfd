"""Rayleigh's step
===============

Which bearing carries most for a given least film? Rayleigh (1918) showed that it is a step with h1/h2 = 1.866, after
0.718 of the length. It carries 28.7 % more than the best plane slider. The map shows the load over both ratios; the
cross is Rayleigh's optimum.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

film, length, speed, viscosity = 20e-6, 0.05, 5.0, 0.03  # m, m, m/s, Pa s
entries = {
    "name": "step",
    "kind": "bearing",
    "geometry": {"shape": "step", "length": length, "film": film, "rise": film, "step": length / 2},
    "lubricant": {"viscosity": viscosity},
    "motion": {"speed": speed},
}
scene = rf.read_scene(entries)
rises, steps = film * np.linspace(0.3, 2.1, 13), length * np.linspace(0.5, 0.9, 13)
rows = rf.sweep(scene, {"geometry.rise": rises, "geometry.step": steps}, models=["reynolds"])
scale = viscosity * speed * (length / film) ** 2  # N/m
load = np.array([row["load_per_width"] for row in rows]).reshape(len(rises), len(steps)) / scale

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
filled = ax.contourf(steps / length, 1 + rises / film, load, levels=12)
fig.colorbar(filled, label="load per width over $\\eta u L^2/h_2^2$ (1)")
ax.plot(0.718, 1.866, "x", color="red", markersize=10)
ax.set(
    xlabel="place of the step over the length (1)", ylabel="film before over behind the step (1)", title="Step bearing"
)
plt.show()
best = rf.solve(rf.replace(scene, {"geometry.rise": 0.866 * film, "geometry.step": 0.718 * length}), model="reynolds")
best_load = best["load"].value / scale
row, column = np.unravel_index(load.argmax(), load.shape)
best_on_map = float(1 + rises[row] / film), float(steps[column] / length)
print(f"largest load {best_load:.4f}; on the map at {best_on_map}")
