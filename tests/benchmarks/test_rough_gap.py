"""A random rough gap by every rung, timed, and one gap by both kinds of mesh; as JSON.

128 × 128 points, 12.8 mean gaps long: 64 × 64 × 16 cells by one process, 128 × 128 × 24 by one and by two. CPU seconds
are those of all three drives. The cheap rungs are timed on 512 × 512 points as well.

Both meshes, columns and snappyHexMesh, take the gap 1 + 0.3 cos cos, 2.5 mean gaps long, which is known exactly, and
1 + 0.99 cos cos, five long, whose walls touch where they are below 0.15 apart; each next mesh is twice as fine.
"""

import json

import numpy as np
import pytest
from places import BENCHMARKS, SCENES

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.foamcases.rough_gap.dictionaries import DRIVES
from roughfilm.foamcases.snappy.snapped import run_snapped, write_snapped
from roughfilm.foamcases.snappy.solid import carved
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import ladder, of_kind
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene
from roughfilm.rom.rough_gap.flow.ritz import ritz_flow

SCENE = SCENES / "random_gap.toml"
RESULTS = BENCHMARKS / "rough_gap.json"
MODELS = of_kind(ladder(rom, foamcases), "rough_gap")

LONG = "geometry.mean_gap=7.8125um"
"""The period is then 12.8 mean gaps long."""

CHEAP = ("homogenized", "slope_corrected")

AGREED = 1e-4
"""Of A: how near one and two processes have to be."""


def row(model, scene, **options):
    found = find("rough_gap", model).solve(scene, Request(**options))
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
        "uncertainty": {name: found[name].uncertainty for name in coefficients},
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
    with replacing(RESULTS, JSON) as path:
        path.write_text(json.dumps({**circumstances(), "rows": rows}, indent=1) + "\n", encoding="utf-8")


UM = 1e-6
COLUMNS, LAYERS = (16, 32, 64), (8, 16)
ROUTES_AGREE = 0.01
"""Of A11, extrapolated."""


def bumps(amplitude, length, smallest_gap, folder, points=256):
    """1 - a cos cos between the walls, in mean gaps; where it is below the smallest gap they touch."""
    wave = np.cos(2 * np.pi * np.arange(points) / points)
    np.save(folder / "lower.npy", amplitude * np.outer(wave, wave) * UM)
    entries = {
        "name": "bumps",
        "kind": "rough_gap",
        "geometry": {
            "surface": str(folder / "lower.npy"),
            "spacing": [f"{length / points * UM!r} m"] * 2,
            "mean_gap": f"{UM!r} m",
        },
        "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
        "flow": {"reynolds_number": 1e-3},
        "mesh": {"smallest_gap": f"{smallest_gap * UM!r} m"},
    }
    return read_scene(entries)


def by_columns(scene, _folder):
    found = [find("rough_gap", "stokes").solve(scene, Request(resolution=n)) for n in COLUMNS]
    return [one.quantities["A11"].value for one in found], [one.numerics.cpu_s for one in found]


def by_snapping(scene, folder):
    walls = scene.walls(max(scene.surface().shape))
    values, cpu_s = [], []
    for layers in LAYERS:
        case = folder / f"snapped-{layers}"
        write_snapped(carved(walls, UM, layers), case, drive=DRIVES[0], reynolds_number=1e-3)
        found = run_snapped(case)
        values.append(float(found.flow_per_width[0]))
        cpu_s.append(found.cpu_s)
    return values, cpu_s


@pytest.mark.benchmark
@pytest.mark.openfoam
@pytest.mark.parametrize(("amplitude", "length", "smallest_gap"), [(0.3, 2.5, 0.01), (0.99, 5.0, 0.15)])
def test_both_meshes_of_one_gap_agree(amplitude, length, smallest_gap, tmp_path):
    scene = bumps(amplitude, length, smallest_gap, tmp_path)
    walls = scene.walls(256)
    stated = {"amplitude": amplitude, "length": length, "contact": float((walls.gap == 0).mean())}
    for route in (by_columns, by_snapping):
        values, cpu_s = route(scene, tmp_path)
        limit = values[-1] + (values[-1] - values[-2]) / 3
        stated[route.__name__] = {"values": values, "cpu_s": cpu_s, "extrapolated": limit}
    columns, snapped = (stated[name]["extrapolated"] for name in ("by_columns", "by_snapping"))
    if not stated["contact"]:
        stated["exact"] = float(ritz_flow(scene.walls(32)).relative.pressure[0, 0])
    path = RESULTS.with_name(f"rough_gap_meshes_{amplitude}.json")
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), **stated}, indent=1) + "\n", encoding="utf-8")
    assert snapped == pytest.approx(columns, rel=ROUTES_AGREE)
    assert columns == pytest.approx(stated.get("exact", columns), rel=ROUTES_AGREE)
