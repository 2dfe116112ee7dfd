"""Sweep the depth of a groove and plot its load by two models."""

import matplotlib.pyplot as plt

import roughfilm as rf

scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
depths = [f"{depth} um" for depth in (5, 10, 15, 20, 25, 30)]
rows = rf.sweep(scene, {"geometry.depth": depths}, models=["inertial_reynolds", "film_slope"])
for model in ("inertial_reynolds", "film_slope"):
    own = [row for row in rows if row["model"] == model]
    plt.plot([1e6 * row["geometry.depth"] for row in own], [row["load_per_area"] for row in own], label=model)
plt.gca().set(xlabel="depth, µm", ylabel="load per area, Pa")
plt.legend()
plt.savefig("load_over_depth.png")
