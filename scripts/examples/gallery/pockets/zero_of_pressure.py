"""Where the pressure of a cell is zero
====================================

How much load does a dimple carry? That depends on the place where the pressure is zero. Along the edge of a periodic
cell, between two dimples, the pressure varies. The load of one and the same flow is 3.5 times as large with zero
pressure in the middle of the edge as with zero at the corner. Results take the mean over the edge.
"""

import matplotlib.pyplot as plt

import roughfilm as rf

cell = {"length": "1 mm", "breadth": "1 mm", "film": "30 um"}
cell["dimples"] = [{"shape": "spherical", "width": "0.3 mm", "depth": "7.5 um"}]
liquid, motion = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}, {"reynolds_number": 160}
scene = rf.read_scene({"name": "dimple", "kind": "pocket", "geometry": cell, "lubricant": liquid, "motion": motion})
result = rf.solve(scene, model="film_slope", resolution=64)

x, y, pressure = (result.fields[name].values for name in ("x", "y", "pressure"))
edge = (pressure[0] + pressure[-1]) / 2  # between the first and the last column, Pa
half = len(edge) // 2
middle = (edge[half - 1] + edge[half]) / 2
load = {
    "corner": result["load_from_corner_per_area"].value,
    "mean of the edge": result["load_per_area"].value,
    "middle of the edge": result["load_per_area"].value - middle,
}
ratio = load["middle of the edge"] / load["corner"]
fig, ax = plt.subplots(figsize=(6, 3.6), layout="constrained")
ax.plot(1e3 * y[0], 1e-3 * edge)
ax.axhline(0, color="0.7", linewidth=0.8)
ax.set(xlabel="across the sliding (mm)", ylabel="pressure along the edge (kPa)")
ax.set_title("Pressure between two dimples, from its mean")
plt.show()
print({place: f"{1e-3 * value:.2f} kPa" for place, value in load.items()}, f"ratio {ratio:.2f}")
