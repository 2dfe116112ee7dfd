"""A random rough gap by every rung, timed: thin films, the slope correction, and OpenFOAM alone and under MPI; as JSON.

128 × 128 points, 12.8 mean gaps long: 64 × 64 × 16 cells by one process, 128 × 128 × 24 by one and by two. CPU seconds
are those of all three drives. The cheap rungs are timed on 512 × 512 points as well.
"""

import json
from pathlib import Path

import pytest

import foamcases.models
import rom.models
from contact.files import replacing
from rom.ladder import find, ladder, of_kind
from rom.provenance import circumstances
from rom.scene import load_scene

ROOT = Path(__file__).parent.parent.parent
SCENE = ROOT / "scripts" / "scenes" / "random_gap.toml"
RESULTS = ROOT / "runs" / "benchmarks" / "rough_gap.json"
MODELS = of_kind(ladder(rom.models, foamcases.models), "rough_gap")

LONG = "geometry.mean_gap=7.8125um"
"""The period is then 12.8 mean gaps long."""

CHEAP = ("homogenized", "slope_corrected")

AGREED = 1e-4
"""Of A: how near one and two processes have to be."""


def row(model, scene, **options):
    found = find(MODELS, model).solve(scene, **options)
    coefficients = {name: found.quantities[name].value for name in ("A11", "A22", "B1", "friction")}
    numerics = found.numerics
    return {
        "model": model,
        "points": scene.surface().shape,
        **options,
        "wall_s": numerics.wall_s,
        "cpu_s": numerics.cpu_s,
        "iterations": numerics.iterations,
        **coefficients,
        "uncertainty": dict(found.provenance["uncertainty"]),
    }


@pytest.mark.benchmark
@pytest.mark.openfoam
def test_cost_of_rough_gaps():
    scene, layered = load_scene(SCENE, [LONG]), load_scene(SCENE, [LONG, "mesh.layers=24"])
    fine = load_scene(SCENE, [LONG, "geometry.surface.points=[512, 512]"])
    rows = [row(name, one) for one in (scene, fine) for name in CHEAP for _ in range(3)]
    rows += [row("stokes", scene, resolution=64)]
    alone, together = (row("stokes", layered, resolution=128, processes=processes) for processes in (1, 2))
    assert together["A11"] == pytest.approx(alone["A11"], rel=AGREED)
    rows += [alone, together, row("navier_stokes", scene, resolution=64)]
    RESULTS.parent.mkdir(parents=True, exist_ok=True)
    with replacing(RESULTS) as path:
        path.write_text(json.dumps({**circumstances(), "rows": rows}, indent=1) + "\n", encoding="utf-8")
