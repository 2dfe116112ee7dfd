"""From a measured surface to Stribeck curves: the table of flow factors and contact pressures, and a sweep of speeds.

Each step runs in a process of its own, from a cold start: with what it takes to import and to load compiled loops.
"""

import json
import os
import re
import subprocess
import sys
import time

import pytest
from places import BENCHMARKS, ROOT, SCENES

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.ladder.provenance import circumstances

RESULTS = BENCHMARKS / "mixed.json"
SCENE = SCENES / "rough_washer.toml"

STEEL = ("--modulus", "210GPa", "--poisson", "0.3", "--hardness", "5GPa")
SURFACES = [("milled_NT1100.opd", "[512, 512]"), ("isotropic.al3d", "[512, 512]"), ("milled_NT1100.opd", "[512, 1024]")]

TABLE_S, CURVES_S = 60.0, 20.0
"""Wall time that a table and curves are to stay below, on two cores that are free."""


def command(*arguments):
    """Run one command of ours alone; what it cost."""
    before, started = os.times(), time.perf_counter()
    asked = [sys.executable, "-m", "roughfilm.cli.main", *map(str, arguments)]
    subprocess.run(asked, cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT)}, check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return {"wall_s": time.perf_counter() - started, "cpu_s": cpu}


KEPT = {}


def note(entries):
    """Write some entries of the results, and keep the others of this run."""
    KEPT.update(entries)
    with replacing(RESULTS, JSON) as scratch:
        stated = {**circumstances(), "load_average": os.getloadavg()[0], **KEPT}
        scratch.write_text(json.dumps(stated, indent=1))


def total(steps):
    return {name: sum(step[name] for step in steps) for name in ("wall_s", "cpu_s")}


@pytest.mark.benchmark
@pytest.mark.parametrize(("name", "points"), SURFACES)
def test_a_measured_surface_becomes_curves(measured_file, tmp_path, name, points):
    """25 loads, the whole table; then 60 speeds under three loads from it. Times are recorded, not judged."""
    cell, contacts, table = (tmp_path / file for file in ("S.h5", "C.h5", "T.h5"))
    grid = ("--set", f"grid.points={points}")
    steps = {
        "surface": command("surface", measured_file(name), *grid, "--out", cell),
        "contact": command("contact", cell, *STEEL, "--loads", "1MPa..3GPa:25", "--out", contacts),
        "factors": command("factors", contacts, "--out", table),
    }
    wall = ("--set", "roughness.kind=surface", "--set", f"roughness.surface={cell}")
    steps["stribeck"] = command("stribeck", SCENE, *wall, "--table", table, "--out", tmp_path / "curves")
    stated = json.loads((tmp_path / "curves" / "stribeck.json").read_text())
    factors = json.loads(
        subprocess.run(
            [sys.executable, "-m", "roughfilm.cli.main", "factors", contacts, "--out", table, "--json"],
            cwd=ROOT,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
    )
    row = {
        "steps": steps,
        "table": {"asked_wall_s": TABLE_S, **total([steps[step] for step in ("surface", "contact", "factors")])},
        "curves": {"asked_wall_s": CURVES_S, **steps["stribeck"]},
        "points_of_table": factors["numerics"]["separations"],
        "points_of_curves": stated["numerics"]["points"],
        "lift_off_m_s": [curve["lift_off"] for curve in stated["curves"]],
    }
    note({re.sub(r"\W+", "_", f"{name} {points}"): row})
    assert factors["numerics"]["separations"] >= 25
    assert stated["numerics"]["points"] == 180
    assert stated["numerics"]["balance"] < 1e-5
