"""Navier-Stokes flow in a groove, by OpenFOAM
===========================================

What does the film model leave out? OpenFOAM solves the Navier-Stokes equations on 60 columns in about a second; its
load is within 1 % of that of film_slope. The case is a directory that can be kept and run by hand.
"""

import tempfile

import matplotlib.pyplot as plt
import pyvista

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "22.5 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 100}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})

with tempfile.TemporaryDirectory() as directory:
    case = rf.write_case(scene, directory + "/case", model="navier_stokes", resolution=60)
    result, mesh = case.run(), case.mesh()
film = rf.solve(scene, model="film_slope")

plotter = pyvista.Plotter(off_screen=True, window_size=(1500, 420))
pressure = 1e-3 * mesh.cell_data["cell_pressure (Pa)"]  # kPa
drawn = plotter.add_mesh(
    mesh.scale((1, 5, 1)), scalars=pressure, cmap="viridis", show_edges=True, show_scalar_bar=False
)
plotter.view_xy()
plotter.camera.tight(padding=0.02, adjust_render_window=False)
fig, ax = plt.subplots(figsize=(6, 2.8), layout="constrained")
ax.imshow(plotter.screenshot())
scale = plt.cm.ScalarMappable(plt.Normalize(*drawn.mapper.scalar_range), "viridis")
fig.colorbar(scale, ax=ax, orientation="horizontal", label="pressure (kPa)")
ax.set_title(f"Pressure on {mesh.n_cells} cells, heights five times enlarged")
ax.set_axis_off()
plt.show()
load, load_of_film = result["load"].value, film["load"].value
print(f"load {load:.0f} Pa by OpenFOAM, {load_of_film:.0f} Pa by film_slope, {result.numerics.cpu_s:.1f} CPU s")
