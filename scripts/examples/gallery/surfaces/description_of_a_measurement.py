"""A description of a measurement
==============================

Which surfaces are as likely as the one that was measured? `fit_description` fits a random field to windows of a
measurement: their mean spectrum, their heights, and how both differ between windows. Half of the windows are held out:
95 of 100 of them should lie within the interval of the seeds. Any seed is a further surface.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt

import roughfilm as rf

text = 'kind = "gaussian"\nsize = ["128 um", "128 um"]\npoints = [128, 128]\nseed = 3\nrms_height = "1 um"\n'
text += 'correlation_length = "6 um"\nanisotropy = 2\nlay_angle = "30 deg"\namplitudes = "random"\n'
text += "height_distribution = { skewness = -0.8 }\n"
with tempfile.TemporaryDirectory() as directory:
    Path(directory, "surface.toml").write_text(text, encoding="utf-8")
    measured = rf.read_surface(Path(directory, "surface.toml"))
    fit = rf.fit_description(measured, windows=16, seeds=40, out=Path(directory, "fitted.toml"))
    seed = rf.read_surface(Path(directory, "fitted.toml"))
inside = {name: held.inside for name, held in fit.held.items()}
skewness = {"windows": [], "seeds": []}
for name, surfaces in (("windows", fit.group.cells), ("seeds", [fit.surface_of(k) for k in range(16)])):
    skewness[name] = [rf.parameters(surface)["Ssk"].value for surface in surfaces]

fig, (left, right) = plt.subplots(1, 2, figsize=(6, 3), layout="constrained")
left.imshow(1e6 * seed.heights.T, extent=(0, 32, 0, 32), origin="lower")
left.set(xlabel="x (µm)", ylabel="y (µm)", title="A seed")
right.loglog(fit.seeds[:, 0], 1e18 * fit.seeds[:, 2], ".", color="0.7", label="seeds")
right.loglog(fit.windows[:, 0], 1e18 * fit.windows[:, 2], ".", label="windows")
right.set(xlabel="contact pressure over E* (1)", ylabel="permeability (µm³)")
right.legend()
plt.show()
