"""Ball on a flat
==============

Does a ball give Hertz's contact? A cap of a ball stands alone on a half-space (boundary "free"). Radius and greatest
pressure agree with Hertz (1882), a³ = 3FR/(4E*) and p0 = 3F/(2πa²), within 0.1 %.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

radius, modulus, poisson, force = 5e-3, 210e9, 0.3, 20.0  # m, Pa, 1, N
composite = modulus / (1 - poisson**2)
a = (0.75 * force * radius / composite) ** (1 / 3)
peak = 1.5 * force / np.pi / a**2
side = 3 * a
x = side * ((np.arange(96) + 0.5) / 96 - 0.5)
heights = -np.add.outer(x**2, x**2) / (2 * radius)
contact = rf.press(heights, spacing=side / 96, modulus=modulus, load=force / side**2, poisson=poisson, boundary="free")
computed_radius = float(np.sqrt(contact.area_fraction * side**2 / np.pi))
computed_peak = float(contact.pressure.max())

fig, (left, right) = plt.subplots(1, 2, figsize=(6, 3), layout="constrained", width_ratios=(1, 1.1))
fig.suptitle("Ball on a flat")
filled = left.pcolormesh(1e6 * x, 1e6 * x, 1e-9 * contact.pressure.T)
left.set(xlabel="x (µm)", ylabel="y (µm)", aspect="equal")
fig.colorbar(filled, label="pressure (GPa)", orientation="horizontal")
line = np.linspace(-a, a, 200)
right.plot(1e6 * line, 1e-9 * peak * np.sqrt(1 - (line / a) ** 2), label="Hertz")
right.plot(1e6 * x, 1e-9 * contact.pressure[:, 48], ".", label="computed")
right.set(xlabel="x (µm)", ylabel="pressure (GPa)", ylim=(0, 1.35e-9 * peak))
right.legend(ncols=2, loc="upper center")
plt.show()
print(
    f"radius {1e6 * computed_radius:.2f} µm, Hertz {1e6 * a:.2f} µm; peak {computed_peak:.4g} Pa, Hertz {peak:.4g} Pa"
)
