"""Leakage of a seal over the load
===============================

How hard must an elastomer be pressed to stop a leak? The leakage falls by orders of magnitude with the load, and is
exactly zero where no open path is left: between 0.45 and 0.50 MPa here. Persson's effective medium is cheaper still
and within 19 % up to 0.2 MPa; it does not know which constriction closes last.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "self_affine", "size": ["42 um", "42 um"], "points": [128, 128], "seed": 20071, "hurst": 0.8}
surface |= {"roll_off": "10.5 um", "cut_off": "1.3125 um", "rms_height": "0.125 um"}
entries = {
    "name": "elastomer seal",
    "kind": "seal",
    "geometry": {"surface": surface},
    "solid": {"modulus": "10 MPa", "poisson": 0.5},
    "load": {"pressure": "0.1 MPa"},
    "liquid": {"density": "1000 kg/m^3", "viscosity": "1 mPa*s"},
    "flow": {"pressure_drop": "10 kPa", "length": "1 mm"},
}
scene = rf.read_scene(entries)
loads = np.array([0.01, 0.02, 0.04, 0.07, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5]) * 1e6  # Pa
models = ["effective_medium", "homogenized_leakage"]
rows = rf.sweep(scene, {"load.pressure": loads}, models=models)
leak = {name: np.array([row["leakage_per_width"] for row in rows if row["model"] == name]) for name in models}
sealed = np.array([row["sealed"] == 1 for row in rows if row["model"] == "homogenized_leakage"])

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for (name, values), style in zip(leak.items(), ("--", "o-"), strict=True):
    ax.semilogy(1e-6 * loads[values > 0], 3.6e9 * values[values > 0], style, label=name)
ax.axvspan(1e-6 * loads[~sealed][-1], 1e-6 * loads[sealed][0], color="0.85", label="seals in between")
ax.set(xlabel="mean pressure (MPa)", ylabel="leakage per width (mg/(m h))", title="Elastomer on steel, 10 kPa")
ax.legend()
plt.show()
seals_between = float(loads[~sealed][-1]), float(loads[sealed][0])
ratio = leak["effective_medium"][:7] / leak["homogenized_leakage"][:7]
