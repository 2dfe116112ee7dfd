"""A result, stored and read again
===============================

What is in a result? Quantities with unit and uncertainty, fields, warnings, cost and origin. A file keeps them all, and
the same result is a dataset of xarray, with units as attributes. Printing a result shows its main parts.
"""

import tempfile

import matplotlib.pyplot as plt

import roughfilm as rf

geometry = {"shape": "parabolic", "length": "76.2 mm", "film": "25.4 um", "rise": "25.4 um", "width": "60 mm"}
entries = {"name": "slider", "kind": "bearing", "geometry": geometry, "motion": {"speed": "4.57 m/s"}}
entries["lubricant"] = {"viscosity": "0.039 Pa*s", "cavitation_pressure": "0 Pa"}
result = rf.solve(rf.read_scene(entries), model="reynolds_incompressible")
with tempfile.TemporaryDirectory() as directory:
    rf.save(result, directory + "/slider.h5")
    again = rf.load_result(directory + "/slider.h5")
print(again)

# %%
# A dataset is addressed by place: the middle of the width, or the place of the greatest pressure.
data = again.to_xarray()
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for y in (0.03, 0.015, 0.005):
    line = data["pressure"].sel(y=y, method="nearest")
    ax.plot(1e3 * line["x"], 1e-6 * line, label=f"y = {1e3 * float(line['y']):.0f} mm")
ax.set(
    xlabel="along the sliding (mm)", ylabel=f"pressure (M{data['pressure'].attrs['units']})", title="Parabolic slider"
)
ax.legend()
plt.show()
load, unit, uncertainty = again["load"].value, again["load"].unit, again["load"].uncertainty
peak = data["pressure"].where(data["pressure"] == data["pressure"].max(), drop=True)
peak_place = float(peak["x"][0]), float(peak["y"][0])
print(f"load {again['load']}, greatest pressure at x = {1e3 * peak_place[0]:.1f} mm")
