"""Two grooves in a period
=======================

Do two grooves carry twice as much as one? At Re = 80 two equal grooves in a period of 1 mm carry 2.2 times as much as
one, because the liquid arrives at the second one with the pressure of the first. Their distance changes the load by
less than 1 % as long as the ends of the period, where the pressure is ambient, are far from both.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

liquid = {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"}


def solved(positions):
    """The result of film_slope for grooves at these positions, m."""
    shape = {"profile": "cylindrical", "width": "0.2 mm", "depth": "7.5 um"}
    grooves = [{"position": float(position), **shape} for position in positions]
    geometry = {"length": "1 mm", "film": "30 um", "grooves": grooves}
    entries = {"name": "grooves", "kind": "pocket", "geometry": geometry, "lubricant": liquid}
    return rf.solve(rf.read_scene({**entries, "motion": {"reynolds_number": 80}}), model="film_slope")


one = solved([0.0])
distances = (0.22e-3, 0.36e-3, 0.5e-3)  # m
two = [solved([-distance / 2, distance / 2]) for distance in distances]

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
for result, label in zip([one, *two], ["one", *(f"two, {1e3 * one:.2f} mm apart" for one in distances)], strict=True):
    ax.plot(1e3 * result.fields["position"].values, 1e-3 * result.fields["pressure"].values, label=label)
ax.set(xlabel="along the sliding (mm)", ylabel="pressure above ambient (kPa)", ylim=(-25, 65))
ax.set_title("Pressure of one groove and of two, Re = 80")
ax.legend(ncols=2, loc="upper center")
plt.show()
ratio = np.array([result["load"].value for result in two]) / one["load"].value
saved = [1 - result["friction_plus"].value / 3 for result in (one, *two)]  # 3 is the friction of a smooth wall
print("load over that of one groove:", ratio.round(3), " friction saved:", np.round(saved, 4))
