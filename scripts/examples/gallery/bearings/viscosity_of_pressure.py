"""Viscosity that grows with pressure
==================================

What does Barus' law η = η0 exp(α p) add to the pressure of a slider? In an infinitely wide film of constant density it
follows from the pressure p0 at constant viscosity: p = -ln(1 - α p0)/α. At α p0 = 1 it has no bound: above this speed
no steady film exists, and the solver refuses the scene with these two numbers.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

alpha = 20e-9  # 1/Pa
law = {"law": "barus", "pressure_coefficient": alpha}
entries = {
    "name": "slider",
    "kind": "bearing",
    "geometry": {"shape": "linear", "length": "50 mm", "film": "5 um", "rise": "6 um"},
    "lubricant": {"viscosity": "0.05 Pa*s", "piezoviscosity": law},
    "motion": {"speed": "1 m/s"},
}
scene = rf.read_scene(entries)
at_one = rf.solve(scene, model="reynolds")["pressure_max"].value  # Pa at 1 m/s, viscosity constant
reduced = np.array([0.1, 0.3, 0.5, 0.7, 0.8])  # α p0
rows = rf.sweep(scene, {"motion.speed": reduced / alpha / at_one}, models=["reynolds_cavitating"])
pressure = np.array([row["pressure_max"] for row in rows])
try:
    rf.solve(rf.replace(scene, "motion.speed", 1.05 / alpha / at_one), model="reynolds_cavitating")
except rf.ConvergenceError as error:
    refused = str(error)

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
line = np.linspace(0, 0.9, 100)
ax.plot(line / alpha / at_one, -1e-6 * np.log(1 - line) / alpha, label="closed form")
ax.plot(line / alpha / at_one, 1e-6 * line / alpha, "--", label="viscosity constant")
ax.plot(reduced / alpha / at_one, 1e-6 * pressure, "o", label="reynolds_cavitating")
ax.set(xlabel="speed (m/s)", ylabel="greatest pressure (MPa)", title="Slider with Barus' law")
ax.legend()
plt.show()
