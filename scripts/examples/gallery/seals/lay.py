"""Leakage along and across a lay
==============================

Does the direction of grinding marks matter for a seal? At 5 kPa a ground elastomer leaks five times as much along its
marks as across them, at 40 kPa a hundred times, and at 60 kPa it leaks along them only. The smooth gap with the same
mean lies between both directions. Seals are therefore ground along their circumference.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "gaussian", "size": ["0.8 mm", "0.8 mm"], "points": [256, 256], "seed": 20073}
surface |= {"rms_height": "0.5 um", "correlation_length": "12 um", "anisotropy": 6}
entries = {
    "name": "ground seal",
    "kind": "seal",
    "geometry": {"surface": surface},
    "solid": {"modulus": "10 MPa", "poisson": 0.5},
    "load": {"pressure": "20 kPa"},
    "liquid": {"density": "870 kg/m^3", "viscosity": "10 mPa*s"},
    "flow": {"pressure_drop": "1 kPa", "length": "1 mm"},
}
scene = rf.read_scene(entries)
loads = np.array([5, 10, 20, 40, 60]) * 1e3  # Pa
rows = rf.sweep(scene, {"load.pressure": loads, "flow.direction": ["x", "y"]}, models=["homogenized_leakage"])
permeability = np.array([row["permeability"] for row in rows]).reshape(-1, 2)
gap = np.array([row["mean_gap"] for row in rows])[::2]
along, across = permeability.max(axis=1), permeability.min(axis=1)

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.semilogy(1e-3 * loads, along, "o-", label="along the marks")
ax.semilogy(1e-3 * loads, gap**3, "k--", label="smooth gap of the same mean")
ax.semilogy(1e-3 * loads[across > 0], across[across > 0], "s-", label="across the marks")
ax.set(xlabel="mean pressure (kPa)", ylabel="permeability (m³)", title="Ground elastomer on a flat")
ax.legend()
plt.show()
ratio = along[across > 0] / across[across > 0]
sealed_across = loads[across == 0]
