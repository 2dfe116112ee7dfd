"""Why textured walls carry
========================

Why do textured walls carry? A wavy wall under a flat one carries nothing without cavitation: the pressure falls behind
each wave as much as it rises before it. Cavitation cuts off the low pressures, and the high ones remain. The load is
largest for a cavitation pressure near ambient, and vanishes where the pressure stays above it.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

wall = {"shape": "squared_cosine_inlet", "length": "10 mm", "extent": "10 mm", "wavelength": "1 mm"}
entries = {
    "name": "textured slider",
    "kind": "bearing",
    "geometry": {**wall, "film": "5 um", "amplitude": "5 um"},
    "lubricant": {"viscosity": "0.01 Pa*s", "cavitation_pressure": "-20 kPa"},
    "motion": {"speed": "3 m/s"},
}
scene = rf.read_scene(entries)
results = {model: rf.solve(scene, model=model) for model in ("reynolds", "reynolds_incompressible")}
pressures = -1e3 * np.array([5, 10, 20, 40, 80, 160, 240])  # Pa, from ambient
rows = rf.sweep(scene, {"lubricant.cavitation_pressure": pressures}, models=["reynolds_incompressible"])
load = np.array([row["load_per_width"] for row in rows])

fig, (top, bottom) = plt.subplots(2, figsize=(6, 5.5), layout="constrained")
fig.suptitle("Wavy wall under a flat one")
for model, result in results.items():
    top.plot(1e3 * result.fields["x"].values, 1e-3 * result.fields["pressure"].values, label=model)
top.set(xlabel="along the sliding (mm)", ylabel="pressure (kPa)", ylim=(-240, 420))
top.legend(ncols=2, loc="upper center")
bottom.plot(-1e-3 * pressures, load, "o-")
bottom.set(xlabel="cavitation pressure below ambient (kPa)", ylabel="load per width (N/m)", ylim=(0, None))
plt.show()
without = results["reynolds"]["load"].value
print(f"without cavitation {without:.1e} N/m, with it {results['reynolds_incompressible']['load']}")
