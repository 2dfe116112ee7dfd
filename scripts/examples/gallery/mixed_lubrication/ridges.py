"""Flow factors of ridges
======================

Does the direction of ridges matter? Across ridges the gap resists as resistances in series, A = 1/(h³<h⁻³>); along them
as resistances in parallel, A = <h³>/h³. At a gap of twice the amplitude the factors are 0.433 and 1.375. The computed
values agree with both closed forms within their uncertainty.
"""

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

angle = 2 * np.pi * np.arange(128) / 128
ridges = np.outer(1e-6 * np.cos(angle), np.ones(8))  # m, ridges along y
gaps = np.array([1.1, 1.25, 1.5, 2, 3, 4, 6]) * 1e-6  # m
factors = [rf.flow_factors(ridges, spacing=1e-6, gap=gap) for gap in gaps]
across = np.array([one["A11"].value for one in factors])
along = np.array([one["A22"].value for one in factors])
shear = np.array([one["B1"].value for one in factors])
uncertainty = np.array([one["A11"].uncertainty for one in factors])

ratio = np.linspace(1.05, 6, 200)  # gap over amplitude
exact_across = (ratio**2 - 1) ** 2.5 / ratio**3 / (ratio**2 + 0.5)
exact_along = 1 + 1.5 / ratio**2
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.plot(ratio, exact_along, label="along, closed form")
ax.plot(1e6 * gaps, along, "o", color="C0", label="along, computed")
ax.plot(ratio, exact_across, color="C1", label="across, closed form")
ax.plot(1e6 * gaps, across, "s", color="C1", label="across, computed")
ax.axhline(1, color="0.7", linewidth=0.8)
ax.set(xlabel="mean gap over amplitude (1)", ylabel="flow over that of a smooth gap (1)", title="Sinusoidal ridges")
ax.legend()
plt.show()
print(f"at twice the amplitude: {across[3]:.4f} ± {uncertainty[3]:.0e} across, {along[3]:.4f} along")
