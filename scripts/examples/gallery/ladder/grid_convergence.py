"""Uncertainty of a number
=======================

Can the ± of a result be trusted? A plane slider of infinite width has a closed form. The error of the load falls as the
square of the cell, and the stated uncertainty, which follows from coarser grids, contains it on every grid.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

film, length, speed, viscosity = 20e-6, 0.05, 5.0, 0.03  # m, m, m/s, Pa s
entries = {
    "name": "slider",
    "kind": "bearing",
    "geometry": {"shape": "linear", "length": length, "film": film, "rise": 1.2 * film},
    "lubricant": {"viscosity": viscosity},
    "motion": {"speed": speed},
}
scene = rf.read_scene(entries)
a = 2.2  # film at the inlet over that at the outlet
exact = 6 * viscosity * speed * (length / film) ** 2 / (a - 1) ** 2 * (np.log(a) - 2 * (a - 1) / (a + 1))  # N/m
cells = np.array([16, 32, 64, 128, 256, 512])
loads = [rf.solve(scene, model="reynolds", resolution=int(number))["load"] for number in cells]
values = np.array([load.value for load in loads])
uncertainties = np.array([load.uncertainty for load in loads])
fig, (left, right) = plt.subplots(2, figsize=(6, 5.5), sharex=True, layout="constrained")
left.errorbar(cells, 1e-3 * values, 1e-3 * uncertainties, fmt="o", capsize=4, label="computed ± uncertainty")
left.axhline(1e-3 * exact, color="C1", label="closed form")
left.set(ylabel="load per width (kN/m)", title="Plane slider")
left.legend()
right.loglog(cells, uncertainties / exact, "s--", label="uncertainty")
right.loglog(cells, np.abs(values / exact - 1), "o-", label="error")
right.set_xscale("log", base=2)
right.set_xticks(cells, cells)
right.set(xlabel="cells along the slider (1)", ylabel="part of the load (1)")
right.legend()
plt.show()
order = -float(np.polyfit(np.log(cells), np.log(np.abs(values / exact - 1)), 1)[0])
