"""Whirl of a rotor
================

At which speed does a rotor begin to whirl? A rotor with 4000 kg in each bearing is stable as long as its mass is below
the critical one, which falls with the speed. A lemon bore, whose halves have half of the clearance as preload, raises
the speed from 4460 to 16 400 rpm. The forces of the film are linear, for small motions.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

MASS = 4000.0  # kg in the bearing
entries = {
    "name": "journal with two axial grooves",
    "kind": "bearing",
    "geometry": {"shape": "lobes", "lobes": 2, "arc": "160 deg", "radius": "50 mm", "width": "100 mm"},
    "lubricant": {"viscosity": "20 mPa*s"},
    "motion": {"speed": "3000 rpm"},
    "load": {"force": "10 kN"},
}
entries["geometry"]["clearance"] = "50 um"
speeds = np.geomspace(5, 100, 9)  # m/s
fig, axes = plt.subplots(figsize=(6, 4), layout="constrained")
curves = {}
for name, preload in (("plain halves", 0.0), ("lemon bore", 0.5)):
    scene = rf.replace(rf.read_scene(entries), "geometry.preload", preload)
    (curve,) = rf.dynamics(scene, speeds, resolution=64, mass=MASS)
    curves[name] = curve
    rpm = [p.rotation * 30 / np.pi for p in curve.points]
    axes.loglog(rpm, [p["critical_mass"].value for p in curve.points], "o-", label=name)
axes.axhline(MASS, color="black", linestyle=":")
axes.set(xlabel="speed (rpm)", ylabel="critical mass (kg)", title="Stability of a rigid rotor")
axes.legend()
plt.show()
onset = {name: curve.onset.rotation * 30 / np.pi for name, curve in curves.items()}
print("onset of whirl (rpm):", {name: f"{speed:.0f}" for name, speed in onset.items()})
