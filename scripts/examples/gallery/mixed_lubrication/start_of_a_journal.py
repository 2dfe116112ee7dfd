"""Start of a journal bearing
==========================

At which speed does a shaft lift off from its asperities, and does the shape of the bore matter? A shaft turns in two
rough halves, infinitely wide, plain ones and those of a lemon bore. Both lift off at 0.25 m/s, because the lower half
alone carries there. At 10 m/s the film over the upper half of the lemon bore adds 69 % to the friction.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

surface = {"kind": "gaussian", "size": ["1 mm", "1 mm"], "points": [48, 48], "seed": 11}
surface |= {"rms_height": "0.5 um", "correlation_length": "0.1 mm"}
halves = {"shape": "lobes", "radius": "25 mm", "clearance": "25 um", "lobes": 2, "arc": "160 deg"}
entries = {
    "name": "journal that starts",
    "kind": "bearing",
    "geometry": halves,
    "lubricant": {"viscosity": "20 mPa*s"},
    "motion": {"speed": "1 m/s"},
    "load": {"force_per_width": "200 kN/m"},
    "roughness": {"kind": "surface", "surface": surface},
    "asperities": {"friction": 0.1, "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "3 GPa"}},
}
speeds = np.geomspace(0.01, 10, 10)  # m/s
fig, (top, bottom) = plt.subplots(2, figsize=(6, 5.5), sharex=True, layout="constrained")
curves = {}
for name, preload in (("plain halves", 0.0), ("lemon bore", 0.5)):
    scene = rf.replace(rf.read_scene(entries), "geometry.preload", preload)
    (curves[name],) = rf.stribeck(scene, speeds=speeds, resolution=96)
    points = curves[name].points
    top.loglog([p.speed for p in points], [p.friction_coefficient for p in points], "o-", label=name)
    bottom.semilogx([p.speed for p in points], [100 * p.contact_share for p in points], "o-")
top.set(ylabel="friction coefficient (1)", title="Start of a journal bearing")
top.legend()
bottom.set(xlabel="speed of the surface of the shaft (m/s)", ylabel="load on asperities (%)")
plt.show()
print("lift-off speeds (m/s):", {name: round(curve.lift_off.speed, 3) for name, curve in curves.items()})
