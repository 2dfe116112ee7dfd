"""Where the Reynolds equation fails over slopes
=============================================

How steep may ridges be for the Reynolds equation? It overestimates the flow across long ridges by 0.8 times the mean
square slope: 5 % at an rms slope of 0.27. Over short ridges the error grows less. The model slope_corrected has
both at the cost of a thin film; the points are exact Stokes flows, which its uncertainty contains.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

entries = {
    "name": "wavy gap",
    "kind": "rough_gap",
    "geometry": {"surface": "sinusoid", "amplitude": "3 um", "wavelength": "50 um", "mean_gap": "10 um"},
    "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
    "flow": {"pressure_gradient": "1 MPa/mm"},
}
scene = rf.read_scene(entries)
lengths = np.array([1.25, 2.5, 3.5, 5, 7, 10, 14, 20, 30])  # wavelength over the mean gap
waves = {"geometry.wavelength": 10e-6 * lengths}
rows = rf.sweep(scene, waves, models=["homogenized", "slope_corrected"])
thin, corrected = (np.array([row["A11"] for row in rows[start::2]]) for start in (0, 1))
uncertainty = np.array([row["A11_uncertainty"] for row in rows[1::2]])
slope = np.sqrt(2) * np.pi * 0.3 / lengths  # rms
ratio = corrected / thin
exact = np.array([[20, 0.9969], [10, 0.9878], [5, 0.9538], [2.5, 0.8493], [1.25, 0.6768]])  # Stokes over Reynolds

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.errorbar(slope, ratio, uncertainty / thin, fmt="o-", capsize=3, label="slope_corrected")
ax.plot(slope, 1 - 0.8 * slope**2, "k--", label="1 - 0.8 <slope²>")
ax.plot(np.sqrt(2) * np.pi * 0.3 / exact[:, 0], exact[:, 1], "x", color="C3", markersize=9, label="exact")
ax.set(xlabel="rms slope (1)", ylabel="flow over that by Reynolds (1)", ylim=(0.4, 1.02), title="Flow across ridges")
ax.legend()
plt.show()
