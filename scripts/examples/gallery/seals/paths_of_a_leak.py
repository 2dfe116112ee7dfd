"""Paths of a leak
===============

Where does a pressed seal leak? At 0.05 MPa half of the flow passes over 15 % of the area. At 0.2 MPa, half of the load
that seals it, it passes over 6 %, and a few constrictions decide. Grey is contact; white is liquid almost at rest.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "self_affine", "size": ["42 um", "42 um"], "points": [256, 256], "seed": 20071, "hurst": 0.8}
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
fig, axes = plt.subplots(1, 2, figsize=(6, 3.6), sharey=True, layout="constrained")
carrying, contact = [], []
for ax, load in zip(axes, (0.05e6, 0.2e6), strict=True):
    result = rf.solve(rf.replace(scene, "load.pressure", load), model="homogenized_leakage")
    flow, gap = result.fields["flow"].values, result.fields["gap"].values
    shown = np.ma.masked_where(gap <= 0, flow / flow.mean())
    maps = ax.imshow(shown.T, origin="lower", extent=(0, 42, 0, 42), cmap="Blues", vmin=0, vmax=5)
    ax.set_facecolor("0.6")
    ax.set(xlabel="x, along the flow (µm)", title=f"{1e-6 * load:.2f} MPa, {result['area_fraction'].value:.0%} contact")
    ordered = np.sort(flow.ravel())[::-1].cumsum() / flow.sum()
    carrying.append(float(np.searchsorted(ordered, 0.5) / flow.size))
    contact.append(result["area_fraction"].value)
axes[0].set_ylabel("y (µm)")
fig.colorbar(maps, ax=axes, label="flow over its mean (1)", orientation="horizontal", shrink=0.6, extend="max")
plt.show()
