"""Wall time of a study of Navier-Stokes flows in pockets, by one process for each core, as JSON with the machine.

``-m "benchmark and not slow"`` leaves out the whole published sweep of 640 cases.
"""

import json
import os
import subprocess
import sys
import time

import pytest
from places import BENCHMARKS, ROOT

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.ladder.provenance import circumstances

RESULTS = BENCHMARKS / "batch.json"
COLUMNS = 120
ROUGHFILM = (sys.executable, "-m", "roughfilm.cli.main")

STUDY = f"""
name = "sweep"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = {{widths}}
depth = ["0.25 film", "0.50 film", "0.75 film", "1.00 film", "1.25 film"]
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
reynolds_number = [40, 80, 120, 160]
[[variants]]
geometry.profile = "cylindrical"
[[variants]]
geometry = {{{{ profile = "splined", shift = ["-0.3 width", "0 width", "0.3 width"] }}}}
[study]
models = ["navier_stokes"]
resolution = {{{{ navier_stokes = {COLUMNS} }}}}
"""

WIDTHS = ("0.15", "0.20", "0.25", "0.30", "0.35", "0.40", "0.45", "0.50")
KEPT = {}


@pytest.mark.benchmark
@pytest.mark.openfoam
@pytest.mark.parametrize("cases", [80, pytest.param(640, marks=pytest.mark.slow)])
def test_wall_time_of_a_study(tmp_path, cases):
    widths = WIDTHS if cases == 640 else WIDTHS[3:4]
    study = tmp_path / "study.toml"
    study.write_text(STUDY.format(widths=json.dumps([f"{width} length" for width in widths])))
    started = time.perf_counter()
    command = [*ROUGHFILM, "batch", str(study), "--out", str(tmp_path / "out"), "--json"]
    printed = subprocess.run(
        command, cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT)}, check=True, capture_output=True, text=True
    ).stdout
    KEPT[cases] = {
        "cases": cases,
        "columns": COLUMNS,
        "wall_s": time.perf_counter() - started,
        "load_average": os.getloadavg()[0],
    }
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), "studies": list(KEPT.values())}, indent=1))
    rows = (tmp_path / "out" / "table.csv").read_text().splitlines()
    assert len(rows) == cases + 1, printed
