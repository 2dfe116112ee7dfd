"""Our cell problems beside direct and iterative solvers on the very same arrays: agreement, times as ratios, as JSON.

ROUGHFILM_CELL_PEERS names the environment of the peers, which ``charts/peers/setup_homogenization`` makes; without
it ours runs alone. What takes long is marked: ``-m "benchmark and not slow"`` leaves it out, ``-k`` chooses a case or
a peer.

All but reynoldsflow solve the network that our own faces make, and are given it: of ours everything from the gap on is
timed, χ₃ and e as well. reynoldsflow makes its own of harmonic means and is compared with what that network's A is.
Iterative peers are timed at the loosest of their tolerances whose A is as good as asked.
"""

import json
import os
import subprocess
import sys
import time
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
from places import BENCHMARKS, ROOT

from roughfilm.charts.peer_runs import PROGRAMS, one_thread
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.homogenization.conductance import FaceRule, faces
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.tabulate import INTERPOLATION_TOLERANCE, point_of, table_errors, tabulate
from roughfilm.rom.ladder.provenance import circumstances

PROGRAM = PROGRAMS / "cells.py"
RESULTS = BENCHMARKS / "homogenization.json"

SIDE, WAVES, CONTACT = 1e-3, 8, 0.2
"""Of the surface: its period, m, how many of its longest waves that holds, and how much of it is cut off."""

AGREED, KNOWN = 1e-6, 1e-11
"""Of A: how near every solver has to be to the network's own, and to what that is solved."""

EQUAL, SHORTEST = 1.5e-3, SIDE / 32
"""The error of A of which times are compared, on a surface whose shortest wave is this on every grid, m."""

GRIDS = tuple(range(256, 1537, 32))
"""Nodes along a side, of which the fewest that are as good are timed."""

CONSTANT = 1.1
"""The most memory a node, over the least, from 512² to 4096²."""

DEFAULT = "run_cell:factors"
OURS = (DEFAULT, "run_cell:factors 1e-8", "run_cell:cell")
DIRECT = ("run_superlu:MMD_AT_PLUS_A", "run_superlu:COLAMD", "run_pardiso:", "run_cholmod:amd", "run_cholmod:metis")
ITERATIVE = ("run_pyamg:ruge_stuben", "run_pyamg:aggregation")
BEST = "run_reynoldsflow:petsc-cg.hypre"
REYNOLDSFLOW = (
    BEST,
    *(f"run_reynoldsflow:{way}" for way in ("petsc-cg.gamg", "cholesky", "pardiso", "scipy.amg-rs")),
    "run_reynoldsflow:scipy.amg-smooth_aggregation",
)
CASES = {
    (512, 8): OURS,
    (1024, 8): (*OURS, *DIRECT, *ITERATIVE, *REYNOLDSFLOW),
    (1024, 2): (*OURS, *DIRECT, *ITERATIVE, *REYNOLDSFLOW),
    (2048, 8): (*OURS, "run_cholmod:amd", BEST),
    (4096, 8): (DEFAULT,),
}
"""Nodes along a side and in the shortest wave, and who solves it."""

PAIRS = [
    pytest.param(*case, solver, id=f"{case[0]}-{case[1]}-{solver}", marks=[pytest.mark.slow] * (case[0] > 1024))
    for case, solvers in CASES.items()
    for solver in solvers
]


def gap(points, cut_off):
    """Over its mean; the same surface on every grid, in contact where it is cut off."""
    heights = self_affine(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=20071,
        hurst=0.8,
        roll_off=SIDE / WAVES,
        cut_off=cut_off,
        rms_height=1e-6,
    ).heights
    truncated = np.maximum(np.quantile(heights, 1 - CONTACT) - heights, 0)
    return truncated / truncated.mean()


def pressures(h, rule, tolerance=KNOWN):
    """A₁₁ and A₂₂."""
    return np.diag(solve_cell(h, (1.0, 1.0), rule=rule, tolerance=tolerance).factors.pressure)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """What a solver made of a case, in a process of its own, once; what is known by then is written down."""
    folder = tmp_path_factory.mktemp("cells")
    rows = {}

    @cache
    def written(points, cut_off):
        h, place = gap(points, cut_off), folder / f"{points}, {cut_off:.3g}"
        place.mkdir()
        made = {"gap": h, **{name: getattr(faces(h), name) for name in ("east", "north", "drag")}}
        for name, values in made.items():
            np.save(place / f"{name}.npy", values)
        return place

    @cache
    def own(points, cut_off, rule):
        return pressures(gap(points, cut_off), rule).tolist()

    def solve(points, cut_off, solver, right=None, error=AGREED, repeats=5):
        key = (points, cut_off, solver, error)
        if key not in rows:
            asked, result = folder / "asked.json", folder / "result.json"
            rule = FaceRule.HARMONIC if solver.startswith("reynoldsflow") else FaceRule.LINEAR
            right = own(points, cut_off, rule) if right is None else right
            asked.write_text(json.dumps({"right": right, "error": error, "repeats": repeats}))
            command = [python(solver), PROGRAM, solver, written(points, cut_off), asked, result]
            subprocess.run(command, env=os.environ | {"PYTHONPATH": str(ROOT)} | one_thread(), check=True)
            rows[key] = {"load_average": os.getloadavg()[0], **json.loads(result.read_text())}
            note({"cases": [stated(rows, *key) for key in rows]})
        return rows[key]

    return solve


def stated(rows, points, cut_off, solver, error):
    """A row with what it is, and its time over ours."""
    row, ours = rows[points, cut_off, solver, error], rows.get((points, cut_off, DEFAULT, error))
    case = {"points": points, "points_per_wave": round(cut_off * points / SIDE), "contact": CONTACT, "solver": solver}
    ratio = {"cpu_over_ours": row["cpu_s"] / ours["cpu_s"]} if ours and "failed" not in row else {}
    used = {"bytes_per_node": (row["peak_bytes"] - row["bytes_before"]) / points**2} if "failed" not in row else {}
    return {**case, "asked": error, **row, **ratio, **used}


def note(entries):
    """Write some entries of the results, and keep the others of this run."""
    KEPT.update(entries)
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), **KEPT}, indent=1))


KEPT = {}

CHECKED = 20
"""Number of random gaps at which a table is compared with cells."""


def python(solver):
    """Of the project, or of the peers' environment."""
    if solver in OURS:
        return sys.executable
    if "ROUGHFILM_CELL_PEERS" not in os.environ:
        pytest.skip(
            "the peers are absent: run roughfilm/charts/peers/setup_homogenization and set ROUGHFILM_CELL_PEERS"
        )
    return Path(os.environ["ROUGHFILM_CELL_PEERS"]) / "bin" / "python"


@pytest.mark.benchmark
@pytest.mark.parametrize(("points", "shortest", "solver"), PAIRS)
def test_a_solver_finds_the_same_factors_as_ours(solved, points, shortest, solver):
    find = partial(solved, points, shortest * SIDE / points)
    found, ours = find(solver), find(DEFAULT)
    assert "failed" not in found
    assert found["error"] <= AGREED
    if "shear" in found:
        np.testing.assert_allclose(found["shear"], ours["shear"], rtol=0, atol=max(AGREED, found["residual"]))


@pytest.mark.benchmark
def test_at_an_equal_error_of_a_ours_needs_fewer_nodes(solved):
    """Both rules tend to the same A, at second order; the truth is extrapolated from two grids by ours."""
    at = {rule: [pressures(gap(n, SHORTEST), rule) for n in (1024, 2048)] for rule in FaceRule}
    limits = {rule: fine + (fine - coarse) / 3 for rule, (coarse, fine) in at.items()}
    truth = limits[FaceRule.LINEAR]
    np.testing.assert_allclose(limits[FaceRule.HARMONIC], truth, rtol=EQUAL / 50)
    fewest = {
        rule: next(
            n for n in GRIDS if np.max(np.abs(pressures(gap(n, SHORTEST), rule, EQUAL / 100) / truth - 1)) <= EQUAL
        )
        for rule in FaceRule
    }
    right = truth.tolist()
    ours = solved(fewest[FaceRule.LINEAR], SHORTEST, DEFAULT, right, EQUAL)
    found = {
        name: solved(fewest[FaceRule.HARMONIC], SHORTEST, name, right, EQUAL)
        for name in (BEST, "run_reynoldsflow:cholesky")
    }
    least = min(row["cpu_s"] for row in found.values())
    note({"equal_error": {"error": EQUAL, "points": fewest, "cpu_over_ours": least / ours["cpu_s"]}})
    assert max(row["error"] for row in (ours, *found.values())) <= EQUAL
    assert fewest[FaceRule.LINEAR] < fewest[FaceRule.HARMONIC]


@pytest.mark.benchmark
@pytest.mark.slow
def test_memory_grows_as_the_nodes_do(solved):
    rows = {n: solved(n, 8 * SIDE / n, DEFAULT) for n in (512, 1024, 2048, 4096)}
    each = [(row["peak_bytes"] - row["bytes_before"]) / n**2 for n, row in rows.items()]
    assert max(each) <= CONSTANT * min(each)


TABLES = [("milled_NT1100.opd", (512, 1024)), ("milled_NT1100.opd", (512, 512)), ("isotropic.al3d", (512, 512))]
"""Measured surfaces and the nodes of their cells."""


def cell_of(file, points):
    """The heights and spacing of the periodic cell of a measured surface."""
    prepared = prepare(read_surface(file), read_recipe({"grid": {"points": list(points)}})).surface
    return prepared.heights, prepared.spacing


def timed(work):
    """What a work returns, and its CPU and wall time; it has been done before on a coarse grid, to compile loops."""
    started = time.process_time(), time.perf_counter()
    made = work()
    return made, {"cpu_s": time.process_time() - started[0], "wall_s": time.perf_counter() - started[1]}


@pytest.mark.benchmark
@pytest.mark.parametrize(("name", "points"), TABLES)
def test_a_table_of_a_measured_surface(measured_file, name, points):
    """Also how many values of A and B at random gaps are within the tolerance beyond their own uncertainty."""
    heights, spacing = cell_of(measured_file(name), points)
    tabulate(heights[::16, ::16], tuple(16 * step for step in spacing), tolerance=0.1)
    table, spent = timed(lambda: tabulate(heights, spacing))
    body = Separations(heights=heights)
    gaps = np.exp(np.random.default_rng(5).uniform(np.log(table.narrowest), np.log(table.widest), CHECKED))
    separations = [body.at_mean_gap(float(gap)) for gap in gaps]
    cells = [point_of(body.gap(one), spacing, one, rule=FaceRule.LINEAR, deformed=True) for one in separations]
    within = float(np.mean([table_errors(table, one)[0] <= INTERPOLATION_TOLERANCE for one in cells]))
    row = {"points": len(table.points), "interpolation_error": table.interpolation_error, "within": within, **spent}
    note({f"table of {name}, {points[0]} x {points[1]}": row})
    assert within >= 0.9


@pytest.mark.benchmark
@pytest.mark.parametrize(("name", "points"), TABLES)
def test_a_table_of_a_pressed_surface(measured_file, name, points):
    heights, spacing = cell_of(measured_file(name), points)
    solids = {"composite_modulus": 210e9 / (1 - 0.3**2), "hardness": 5e9, "loads": np.geomspace(1e6, 3e9, 25)}
    tabulate_pressed(heights[::16, ::16], tuple(16 * step for step in spacing), tolerance=0.1, **solids)
    made, spent = timed(lambda: tabulate_pressed(heights, spacing, **solids))
    table = made.factors
    row = {"points": len(table.points), "interpolation_error": table.interpolation_error, **spent}
    note({f"table of {name} pressed, {points[0]} x {points[1]}": row})
    assert len(table.points) >= 25
