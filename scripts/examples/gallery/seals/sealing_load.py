"""Leakage until a seal closes
===========================

At which load does a seal close? leakage_curve finds the sealing loads of a surface in both directions, and its leakage
up to them: for one period between two reservoirs (direct) and for the surface repeated (homogenized).
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
curve = rf.leakage_curve(rf.read_scene(entries))
loads = np.array([row["load"] for row in curve.rows])
leak = {name: np.array([row[f"leakage_{name}"] for row in curve.rows]) for name in ("direct_x", "homogenized_x")}
threshold = curve.sealing["homogenized_x"]

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for (name, values), style in zip(leak.items(), ("s-", "o--"), strict=True):
    ax.semilogy(1e-6 * loads[values > 0], 3.6e9 * values[values > 0], style, markersize=4, label=name)
ax.axvline(1e-6 * threshold.load, color="0.5", label="sealing load")
ax.set(xlabel="mean pressure (MPa)", ylabel="leakage per width (mg/(m h))", title="Elastomer on steel, 10 kPa")
ax.legend()
plt.show()
light = leak["direct_x"][0] / leak["homogenized_x"][0]
print(f"seals at {1e-6 * threshold.load:.3f} MPa with {threshold.area_fraction:.1%} in contact")
