"""Bearing of a pin that swings
============================

What carries a pin whose speed changes its sign, such as that of a piston? With the speed the wedge changes its side,
and the shaft follows it through the bore. The film is thinnest not at the reversal, where squeeze carries the load, but
near the largest speed, when the shaft crosses the line of the load. A pin that swings twice as often takes less oil
along, and its film is thinner. The grid is coarse.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

entries = {
    "name": "pin",
    "kind": "bearing",
    "geometry": {"shape": "lobes", "lobes": 2, "arc": "160 deg", "radius": "15 mm", "clearance": "15 um"},
    "lubricant": {"viscosity": "10 mPa*s", "cavitation_pressure": "-0.1 MPa"},
}
entries["geometry"]["width"] = "25 mm"
fig, axes = plt.subplots(figsize=(6, 4), layout="constrained")
least = {}
for period in (400, 200):
    table = {"time": [f"{period * part} ms" for part in (0, 0.25, 0.5, 0.75)], "period": f"{period} ms"}
    table |= {"speed": ["0.8 m/s", "0 m/s", "-0.8 m/s", "0 m/s"], "load": ["600 N"] * 4}
    scene = rf.read_scene({**entries, "motion": {"speed": "0.8 m/s", "over_time": table}})
    march = rf.march(scene, end=6e-3 * period, cells=(24, 8), uncertainty=False)
    late = march.time >= march.first
    turn = (march.time[late] - march.first) / (march.last - march.first)
    axes.plot(turn, 1e6 * march["film_min"][late], label=f"{period} ms")
    least[period] = (float(march["film_min"][late].min()), float(turn[np.argmin(march["film_min"][late])]))
for reversal in (0.25, 0.75):
    axes.axvline(reversal, color="black", linestyle=":")
axes.set(xlabel="time over the period (1)", ylabel="least film (µm)", title="Dotted: the speed changes its sign")
axes.legend()
plt.show()
print("least film (µm):", {period: f"{1e6 * film:.2f} at {at:.2f}" for period, (film, at) in least.items()})
