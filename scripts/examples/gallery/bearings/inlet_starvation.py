"""Starved inlet of a slider
=========================

How full must the inlet of a slider be? The parabolic slider of Vijayaraghavan and Keith (1989) takes in 0.564 of what
the gap at its inlet can carry, u h/2; more does not change its load. Below this the flow is θ u h/2 and the film begins
later. θ = 0.5 fills only the narrowest place, half as high as the inlet, and carries nothing.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

film, rise, length, speed = 25.4e-6, 25.4e-6, 76.2e-3, 4.57  # m, m, m, m/s
entries = {
    "name": "parabolic slider",
    "kind": "bearing",
    "geometry": {"shape": "parabolic", "length": length, "film": film, "rise": rise},
    "lubricant": {"viscosity": "0.039 Pa*s", "cavitation_pressure": "0 Pa"},
    "motion": {"speed": speed},
}
scene = rf.read_scene(entries)
inlets = np.array([0.51, 0.52, 0.53, 0.54, 0.55, 0.56, 1.0])  # filled fraction θ of the gap at the inlet
model = "reynolds_incompressible"
results = [rf.solve(rf.replace(scene, "boundary.inlet", {"theta": theta}), model=model) for theta in inlets]

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for theta, result in zip(inlets, results, strict=True):
    x, pressure = result.fields["x"].values[:, 0], result.fields["pressure"].values[:, 0]
    ax.plot(x / length, 1e-6 * pressure, label=f"θ = {theta:.2f}")
ax.set(xlabel="x/L (1)", ylabel="pressure (MPa)", title="Pressure of a slider with a starved inlet")
ax.legend()
plt.show()
load = np.array([result["load"].value for result in results])
flow = np.array([result["inlet_flow_per_width"].value for result in results])  # m²/s
start = [result["film_start"].value for result in results]
limit = float(flow[-1] / (speed * (film + rise) / 2))
