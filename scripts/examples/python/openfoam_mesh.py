"""Run one OpenFOAM case and save its cells with velocity and pressure for ParaView."""

import roughfilm as rf

scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
case = rf.write_case(scene, "case", model="navier_stokes", resolution=60)
result = case.run()
mesh = case.mesh()
mesh.save("flow.vtu")
print(f"load {result['load'].value:.4g} {result['load'].unit}, {mesh.n_cells} cells: {', '.join(mesh.cell_data)}")
