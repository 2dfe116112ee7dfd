"""A study of many cases
=====================

How are many cases solved and kept? A study is a scene file with lists of values. run_study solves its cases in parallel
and writes each result; a second call continues where the first one stopped. Here the load grows in proportion to the
Reynolds number, by inertial_reynolds exactly, and by film to within 15 % up to Re = 80.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

text = """name = "grooves"
kind = "pocket"
geometry = { length = "1 mm", film = "30 um", width = ["0.2 length", "0.4 length"], depth = "0.5 film" }
lubricant = { viscosity = "0.01 Pa*s", density = "1000 kg/m^3" }
motion = { reynolds_number = [10, 20, 40, 80] }
study = { models = ["inertial_reynolds", "film"] }
"""
with tempfile.TemporaryDirectory() as directory:
    (file := Path(directory, "study.toml")).write_text(text, encoding="utf-8")
    cases = rf.load_study(file).cases
    rf.run_study(file, Path(directory, "out"), processes=1)
    table = rf.read_table(Path(directory, "out", "table.h5"))
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
load = {}
for model, style in (("inertial_reynolds", "--"), ("film", "o-")):
    for width in (0.2, 0.4):
        row = (table["model"] == model) & np.isclose(table["width_plus"], width)
        load[model, width] = table["load_plus"][row]
        ax.plot(table["reynolds_number"][row], load[model, width], style, label=f"{model}, width {width} mm")
ax.set(xlabel="Reynolds number (1)", ylabel="dimensionless load (1)", title="Load of grooves, 15 µm deep")
ax.legend()
plt.show()
