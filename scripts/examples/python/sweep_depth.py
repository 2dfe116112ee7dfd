"""Sweep the depth of a groove and plot its load by two models."""

import matplotlib.pyplot as plt

import roughfilm as rf

scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
for model in ("inertial_reynolds", "film_slope"):
    rows = rf.sweep(scene, {"geometry.depth": ["5 um", "10 um", "15 um", "20 um", "25 um"]}, models=[model])
    plt.plot([1e6 * row["geometry.depth"] for row in rows], [row["load_per_area"] for row in rows], label=model)
plt.gca().set(xlabel="depth, µm", ylabel="load per area, Pa")
plt.legend()
plt.savefig("load_over_depth.png")
