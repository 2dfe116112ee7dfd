"""CPU time of films that rupture, on a line of 100 000 cells and in the plane, as JSON with the machine."""

import json
import time
from dataclasses import replace

import pytest
from places import BENCHMARKS, SCENES

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import load_scene, read_scene

SLIDER = SCENES / "parabolic_slider.toml"
RESULTS = BENCHMARKS / "films.json"
REPEATS = 5
LINES = [(bulk, theta, 100_000) for bulk in (0.07, 0.3, 1, 10) for theta in (0.55, 0.8, 1)]
PLANES = [(bulk, theta, cells) for bulk in (0.07, 10) for theta in (0.55, 1) for cells in (128, 256, 512, 1024)]
POCKETS = (128, 256, 512, 1024)
POCKETED = {
    "name": "pad with a pocket (Bertocchi et al. 2013, small pocket)",
    "kind": "bearing",
    "geometry": {
        "shape": "linear",
        "length": "20 mm",
        "width": "10 mm",
        "film": "1 um",
        "rise": "0.1 um",
        "texture": {
            "profile": "box",
            "length": "6 mm",
            "width": "7 mm",
            "depth": "0.4 um",
            "start": "4 mm",
            "pitch": "6 mm",
            "pitch_across": "10 mm",
            "columns": 1,
            "rows": 1,
        },
    },
    "lubricant": {
        "viscosity": "0.01 Pa*s",
        "cavitation_pressure": "-100 kPa",
        "compressibility": {"law": "dowson_higginson"},
        "piezoviscosity": {"law": "barus", "pressure_coefficient": "12 GPa^-1"},
    },
    "motion": {"speed": "1 m/s"},
}


def timed(bulk, theta, cells, *, plane):
    """CPU seconds of a slider, its steps on all grids and its load, N or N/m."""
    changes = [f"lubricant.compressibility.bulk_modulus={bulk} GPa", f"boundary.inlet.theta={theta}"]
    problem = load_scene(SLIDER, changes + (["geometry.width=76.2 mm"] if plane else [])).problem()
    size = (cells, cells if plane else 1)
    return {"bulk_modulus_GPa": bulk, "theta": theta} | solved(problem, size)


def pocketed(cells):
    """CPU seconds of a pad with a pocket, its steps on all grids and its load, N."""
    return solved(read_scene(POCKETED).problem(), (cells, cells))


def solved(problem, size):
    """CPU seconds of some repeats, sorted, with the steps on all grids and the load."""
    solve(replace(problem), (32, min(32, size[1])))
    times = []
    for _ in range(REPEATS):
        started = time.process_time()
        found = solve(problem, size)
        times.append(time.process_time() - started)
    row = {"cells": list(size), "cpu_s": sorted(times)}
    return row | {"iterations": [level.iterations for level in found.levels], "load": found.levels[-1].load}


@pytest.mark.benchmark
def test_cost_of_films():
    lines = [timed(*one, plane=False) for one in LINES]
    planes = [timed(*one, plane=True) for one in PLANES]
    pockets = [pocketed(cells) for cells in POCKETS]
    with replacing(RESULTS, JSON) as scratch:
        rows = {"lines": lines, "planes": planes, "pockets": pockets}
        scratch.write_text(json.dumps({**circumstances(), **rows}, indent=1))
    assert max(row["cpu_s"][0] for row in lines) < 0.1
    assert max(row["cpu_s"][0] for row in planes if row["cells"][0] == 512) < 2
