"""Models and their costs
======================

Which models are there, and what do they cost? A model is known by the effects that it includes. The models of a pocket
take from a quarter of a millisecond to seconds: Navier-Stokes in OpenFOAM costs ten thousand times as much as Reynolds.
"""

import matplotlib.pyplot as plt

import roughfilm as rf

groove = {"length": "1 mm", "film": "30 um", "profile": "cylindrical", "width": "0.3 mm", "depth": "7.5 um"}
liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}
motion = {"reynolds_number": 40}
scene = rf.read_scene({"name": "groove", "kind": "pocket", "geometry": groove, "lubricant": liquid, "motion": motion})
models = rf.models("pocket")
costs = {model.name: model.cost(scene, model.resolution_of(scene)) for model in models}  # CPU s

fig, ax = plt.subplots(figsize=(6, 3.4), layout="constrained")
names = [f"{one.name}\n{', '.join(effect.value for effect in one.keeps) or 'viscous flow alone'}" for one in models]
bars = ax.barh(names, list(costs.values()), color=["C0" if one.complete else "C1" for one in models])
ax.bar_label(bars, [f" {cost:.2g} s" for cost in costs.values()])
ax.set(
    xscale="log", xlim=(1e-4, 40), xlabel="CPU time (s)", title="Models of a pocket (orange: an effect approximated)"
)
plt.show()
ratio = costs["navier_stokes"] / costs["reynolds"]
