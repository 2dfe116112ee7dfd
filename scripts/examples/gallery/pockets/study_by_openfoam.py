"""OpenFOAM cases of a study
=========================

How are many OpenFOAM cases written, run and read? write_study writes a directory for each case, with scripts for any
machine with OpenFOAM. collect_study checks and reads the cases, and solves the models that need no OpenFOAM. Meshes
of 40 columns agree with film_slope within 2.1 %.
"""

import subprocess
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import roughfilm as rf

text = """name = "grooves"
kind = "pocket"
geometry = { length = "1 mm", film = "30 um", width = "0.3 mm", depth = ["0.25 film", "0.75 film", "1.25 film"] }
lubricant = { viscosity = "0.01 Pa*s", density = "1000 kg/m^3" }
motion = { reynolds_number = 80 }
study = { models = ["film_slope", "navier_stokes"], resolution = { navier_stokes = 40 } }
"""
with tempfile.TemporaryDirectory() as directory:
    (file := Path(directory, "study.toml")).write_text(text, encoding="utf-8")
    cases = rf.write_study(file, directory + "/cases")
    subprocess.run(["./Allrun.all"], cwd=directory + "/cases", check=True, capture_output=True)
    table = rf.collect_study(directory + "/cases")
fig, ax = plt.subplots(figsize=(6, 4), layout="constrained")
load = {}
for model, style in (("film_slope", "-"), ("navier_stokes", "o")):
    rows = table["model"] == model
    load[model] = table["load_plus"][rows]
    ax.plot(table["depth_plus"][rows], load[model], style, label=model)
ax.set(xlabel="depth over film (1)", ylabel="dimensionless load (1)", title="Grooves at Re = 80")
ax.legend()
plt.show()
difference = np.abs(load["film_slope"] / load["navier_stokes"] - 1)
