"""Stribeck curve of a ground washer
=================================

At which speed does a washer of ground steel lift off? Its ridges run along the sliding, as grinding leaves them. The
friction is least near the lift-off, which is at 0.47 m/s under 0.5 MPa and grows in proportion to the load. The
bars are the uncertainty by coarser grids, which is estimated at every third speed.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "gaussian", "size": ["3 mm", "3 mm"], "points": [256, 256], "seed": 504, "anisotropy": 20}
surface |= {"rms_height": "2.021 um", "correlation_length": "0.06 mm"}
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
speeds = np.geomspace(1e-2, 10, 13)  # m/s
curves = rf.stribeck(rf.read_scene(entries), speeds=speeds, loads=[0.5e6, 1e6, 2e6])

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for curve in curves:
    friction = [point.friction_coefficient for point in curve.points]
    errors = [point.uncertainty.get("friction_coefficient", 0) for point in curve.points]
    ax.errorbar(speeds, friction, errors, fmt="o-", markersize=4, capsize=3, label=f"{1e-6 * curve.pressure:.1f} MPa")
ax.set(xscale="log", xlabel="sliding speed (m/s)", ylabel="friction coefficient (1)", title="Stribeck curves")
ax.legend(title="mean pressure")
plt.show()
lift_off = np.array([curve.lift_off.speed for curve in curves])
uncertainty = np.array([curve.lift_off.uncertainty for curve in curves])
