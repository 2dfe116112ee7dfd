"""Pressure map of a journal bearing
=================================

Where does the film of a journal bearing carry, and where is it ruptured? The map shows the unwrapped film, which is
supplied at the widest place and at its sides. Behind the narrowest place (180°) it ruptures; the hatched part is not
full. The load is the integral of the pressure, 5263 N.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

geometry = {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "50 mm", "eccentricity": 0.6}
entries = {"name": "journal", "kind": "bearing", "geometry": geometry}
scene = rf.read_scene({**entries, "lubricant": {"viscosity": "0.02 Pa*s"}, "motion": {"speed": "2 m/s"}})
result = rf.solve(scene, model="reynolds_cavitating")

x, y = result.fields["x"].values, result.fields["y"].values  # m
angle, pressure = np.degrees(x / 0.025), result.fields["pressure"].values
fig, ax = plt.subplots(figsize=(6, 3.6), layout="constrained")
filled = ax.contourf(angle, 1e3 * y, 1e-6 * pressure, levels=12, cmap="YlOrRd")
fig.colorbar(filled, label="pressure above ambient (MPa)")
full = result.fields["density_ratio"].values > 1 - 1e-9
ax.contourf(angle, 1e3 * y, ~full, levels=[0.5, 1.5], colors="none", hatches=["///"])
ax.set(xlabel="angle from the widest place (°)", ylabel="across (mm)", title="Journal bearing, eccentricity 0.6")
ax.set_xticks(range(0, 361, 60))
plt.show()

turn = x / 0.025
force = [np.trapezoid(np.trapezoid(pressure * part, y[0], axis=1), x[:, 0]) for part in (np.cos(turn), np.sin(turn))]
load, integral = result["load"], float(np.hypot(*force))
attitude = result["attitude_angle"].value
print(f"load {load}, integral of the pressure {integral:.0f} N, line of the load at {attitude:.1f}°")
