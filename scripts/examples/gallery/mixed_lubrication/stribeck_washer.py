"""Stribeck curve of a rough washer
================================

How does the friction of a washer depend on its speed? At low speed the asperities carry, and the friction coefficient
approaches that of the boundary, 0.1. With the speed the film takes over the load, and the friction falls to a minimum
near the lift-off. Four times the load moves the lift-off from 0.14 to 0.60 m/s. The grid is coarse.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "gaussian", "size": ["1 mm", "1 mm"], "points": [48, 48], "seed": 504}
surface |= {"rms_height": "1 um", "correlation_length": "0.1 mm"}
shape = {"shape": "washer", "inner_radius": "150 mm", "outer_radius": "180 mm", "pockets": 30}
entries = {
    "name": "rough washer",
    "kind": "bearing",
    "geometry": {**shape, "film": "10 um", "pocket": {"depth": "0.5 mm", "share": 0.5, "extent": "15 mm"}},
    "lubricant": {"viscosity": "0.14 Pa*s", "cavitation_pressure": "-0.1 MPa"},
    "motion": {"speed": "0.5 m/s"},
    "boundary": {"sides": {"low": "0.1 MPa"}},
    "roughness": {"kind": "surface", "surface": surface},
    "asperities": {"friction": 0.1, "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "5 GPa"}},
}
speeds = np.geomspace(1e-3, 10, 9)  # m/s
curves = rf.stribeck(rf.read_scene(entries), speeds=speeds, loads=[0.5e6, 2e6], resolution=24)
fig, (top, bottom) = plt.subplots(2, figsize=(6, 5.5), sharex=True, layout="constrained")
for curve in curves:
    top.semilogx(speeds, [p.friction_coefficient for p in curve.points], "o-", label=f"{1e-6 * curve.pressure:.1f} MPa")
    bottom.semilogx(speeds, [100 * p.contact_share for p in curve.points], "o-")
top.set(ylabel="friction coefficient (1)", title="Stribeck curves")
top.legend(title="mean pressure")
bottom.set(xlabel="sliding speed (m/s)", ylabel="load on asperities (%)")
plt.show()
lift_off = [curve.lift_off.speed for curve in curves]
print("lift-off speeds (m/s):", np.round(lift_off, 3))
