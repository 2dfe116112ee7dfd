"""Flow factors of a random surface
================================

How much does roughness resist the flow in a narrow gap? The factor A11 multiplies the flow of a smooth gap as wide as
the mean gap. Patir and Cheng (1978) take the separation of the mean planes instead of the mean gap. In their terms the
factor of a Gaussian surface lies above their fit 1 - 0.9 exp(-0.56 h/Sq), by 0.16 at h = 0.64 Sq and 0.07 at 1.5 Sq.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

described = """kind = "gaussian"
size = ["0.5 mm", "0.5 mm"]
points = [128, 128]
seed = 20071
rms_height = "1 um"
correlation_length = "20 um"
"""
with tempfile.TemporaryDirectory() as directory:
    (file := Path(directory, "rough.toml")).write_text(described, encoding="utf-8")
    surface = rf.read_surface(file)
factors = [rf.flow_factors(surface, gap=gap * 1e-6) for gap in (0.8, 1, 1.5, 2, 3, 4.5, 6)]
separation = np.array([one["separation"].value for one in factors]) * 1e6  # over Sq, which is 1 µm
a, b = (np.array([one[name].value for one in factors]) for name in ("A11", "B1"))
phi = a * (np.array([one["mean_gap"].value for one in factors]) * 1e6 / separation) ** 3  # as Patir and Cheng

fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
ax.plot(separation, a, "o-", label="A11, pressure flow")
ax.plot(separation, phi, "s-", label="A11 over separation³")
ax.plot(separation, b, "^-", label="B1, shear flow")
ax.plot(separation, fit := 1 - 0.9 * np.exp(-0.56 * separation), "k--", label="Patir and Cheng 1978")
ax.set(xlabel="separation over rms height (1)", ylabel="flow factor (1)", title="Gaussian surface without a lay")
ax.legend()
plt.show()
above_fit = phi - fit
