"""Error against cost
==================

Which model is enough for 5 %? The advice estimates the error of each model by laws and short runs, and takes the
cheapest one within the tolerance. For this groove it is inertial_reynolds up to Re = 80, and film_slope at 160, which
costs twenty times as much. Navier-Stokes costs a thousand times as much and is not needed.
"""

import matplotlib.pyplot as plt

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "7.5 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 40}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})
advice = {re: rf.advise(rf.replace(scene, "motion.reynolds_number", re), within=0.05) for re in (10, 40, 80, 160)}

fig, axes = plt.subplots(2, figsize=(6, 6), sharex=True, layout="constrained")
for ax, re in zip(axes, (80, 160), strict=True):
    for one in advice[re].considered:
        color = "C2" if one.verdict == "chosen" else "C0"
        ax.plot(one.cpu_s, 100 * one.error, "o", color=color, markersize=8)
        above = (5, -14) if one.model == "film" else (5, 6)
        ax.annotate(one.model, (one.cpu_s, 100 * one.error), xytext=above, textcoords="offset points")
    ax.axhline(5, color="0.5", linestyle="--")
    ax.set(xscale="log", yscale="log", xlim=(1e-4, 60), ylim=(0.5, 3000), ylabel="error in the load (%)")
    ax.set_title(f"Re = {re}: {advice[re].chosen.model} is enough for 5 % (dashed)")
axes[1].set_xlabel("CPU time (s)")
plt.show()
chosen = {re: one.chosen.model for re, one in advice.items()}
print(chosen)
