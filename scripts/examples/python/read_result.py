"""Store a result, read it again, and take its pressure as a NumPy array."""

import numpy as np

import roughfilm as rf

scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
rf.save(rf.solve(scene, model="film_slope"), "pocket.h5")
result = rf.load_result("pocket.h5")
pressure = result.fields["pressure"].values
np.save("pressure.npy", pressure)
print(f"{result.model}: load {result['load'].value:.4g} {result['load'].unit}")
print(f"pressure {pressure.min():.4g} to {pressure.max():.4g} Pa at {pressure.size} points")
