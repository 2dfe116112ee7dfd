"""Whirl of a rotor in hot oil
===========================

Does the heat of the film change the speed at which a rotor begins to whirl? Friction heats the oil of this bearing from
45 °C at the supply to 57 °C at 2300 rpm and 72 °C at 9500 rpm. In thinner oil the shaft is farther from the middle of
its bore, where it is more stable: a rotor with 1000 kg in the bearing begins to whirl at 5590 rpm. The viscosity of the
supplied oil would give 4970 rpm. The nearer the shaft is to the middle, the less the viscosity matters.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

MASS = 1000.0  # kg in the bearing
entries = {
    "name": "journal with two axial grooves",
    "kind": "bearing",
    "geometry": {"shape": "lobes", "lobes": 2, "arc": "160 deg", "radius": "25 mm", "width": "25 mm"},
    "lubricant": {"oil": "ISO VG 32", "temperature": "45 degC"},
    "motion": {"speed": "3000 rpm"},
    "load": {"force": "2 kN"},
}
entries["geometry"]["clearance"] = "40 um"
hot = rf.read_scene(entries)
speeds = np.geomspace(6, 25, 4)  # m/s
fig, (warm, stable) = plt.subplots(1, 2, figsize=(6, 3.6), layout="constrained")
curves = {}
for name, scene in (("oil as supplied", hot.isothermal()), ("oil that heats", hot)):
    (curve,) = rf.dynamics(scene, speeds, mass=MASS)
    curves[name] = curve
    rpm = [p.rotation * 30 / np.pi for p in curve.points]
    stable.loglog(rpm, [p["critical_mass"].value for p in curve.points], "o-", label=name)
warm.semilogx(rpm, [p["temperature"].value for p in curve.points], "o-", color="C1")
warm.set(xlabel="speed (rpm)", ylabel="temperature of the film (°C)")
stable.axhline(MASS, color="black", linestyle=":")
stable.set(xlabel="speed (rpm)", ylabel="critical mass (kg)")
stable.legend()
plt.show()
onset = {name: curve.onset.rotation * 30 / np.pi for name, curve in curves.items()}
