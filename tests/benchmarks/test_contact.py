"""Our contact solver beside its peers on the very same arrays: agreement, and times as ratios, as JSON.

ROUGHFILM_PEERS names the environment of the peers, which ``charts/peers/setup`` makes; without it ours runs alone.
Minutes of a peer are marked: ``-m "benchmark and not slow"`` leaves them out, ``-k`` chooses a case or a peer.
"""

import json
import os
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from places import BENCHMARKS, ROOT

from roughfilm.charts.peer_runs import PROGRAMS, TOLERANCES, VIOLATION
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.store import add, finished, row_of
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.ladder.provenance import circumstances

PROGRAM = PROGRAMS / "run.py"
RESULTS = BENCHMARKS / "contact.json"
SIDE = 1e-3
AREA, MEAN_GAP = 1e-5, 1e-6
MODULUS = 2e11


@dataclass(frozen=True, kw_only=True)
class Case:
    """Loads and hardness are over E*; slow peers, and all solvers of a slow case, take more than half a minute."""

    name: str
    points: int
    loads: tuple[float, ...]
    peers: tuple[str, ...] = ()
    slow_peers: tuple[str, ...] = ()
    hardness: float | None = None
    threads: int = 1
    repeats: int = 1
    slow: bool = False


CASES = [
    Case(
        name="512, 10 %",
        points=512,
        loads=(0.00466,),
        peers=("run_aspher", "run_tamaas", "run_contact_mechanics"),
        repeats=3,
    ),
    Case(
        name="512, 30 %, H/E* = 0.05",
        points=512,
        loads=(0.01225,),
        hardness=0.05,
        peers=("run_contact_mechanics",),
        slow_peers=("run_tamaas",),
        repeats=3,
    ),
    Case(
        name="512, 20 loads",
        points=512,
        loads=tuple(np.geomspace(0.00041, 0.0355, 20)),
        peers=("run_aspher",),
        slow_peers=("run_tamaas", "run_contact_mechanics"),
    ),
    Case(
        name="1024, 10 %",
        points=1024,
        loads=(0.00477,),
        peers=("run_aspher",),
        slow_peers=("run_tamaas", "run_contact_mechanics"),
        repeats=9,
    ),
    Case(name="1024, 10 %, 2 threads", points=1024, loads=(0.00477,), peers=("run_aspher",), threads=2, repeats=9),
    Case(
        name="1024, 60 %",
        points=1024,
        loads=(0.0361,),
        peers=("run_aspher",),
        slow_peers=("run_tamaas", "run_contact_mechanics"),
    ),
    Case(
        name="2048, 10 %",
        points=2048,
        loads=(0.00488,),
        peers=("run_aspher",),
        slow_peers=("run_tamaas", "run_contact_mechanics"),
    ),
    Case(name="4096, 10 %", points=4096, loads=(0.00498,), slow_peers=("run_aspher",)),
    Case(name="8192, 10 %", points=8192, loads=(0.00508,), slow=True),
]
PAIRS = [
    pytest.param(
        case,
        solver,
        id=f"{case.name}-{solver}",
        marks=[pytest.mark.slow] if case.slow or solver in case.slow_peers else [],
    )
    for case in CASES
    for solver in ("run_roughfilm", *case.peers, *case.slow_peers)
]
"""Ours and its peers one after the other, so that what else the machine does slows all of them."""


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """What a solver made of a case, in a process of its own, once; what is known by then is written down."""
    folder = tmp_path_factory.mktemp("contact")
    rows = {}

    @cache
    def heights(points):
        np.save(folder / f"{points}.npy", rough(points))
        return folder / f"{points}.npy"

    def solve(case, solver):
        key = (case.name, solver)
        if key not in rows:
            problem, result = folder / "problem.json", folder / "result.json"
            asked = {
                "tolerances": TOLERANCES.get(solver, (VIOLATION,)),
                "violation": VIOLATION,
                "spacing": [SIDE / case.points] * 2,
            }
            if solver in case.slow_peers:
                asked["repeats"] = 1
            problem.write_text(json.dumps(asdict(case) | asked))
            subprocess.run(
                [python(solver), PROGRAM, solver, heights(case.points), problem, result],
                env=os.environ | one_library(case.threads),
                check=True,
            )
            rows[key] = {"load_average": os.getloadavg()[0], **json.loads(result.read_text())}
            with replacing(RESULTS, JSON) as scratch:
                tables = [table(case, rows) for case in CASES]
                scratch.write_text(json.dumps({**circumstances(), "cases": tables}, indent=1))
        return rows[key]

    return solve


def rough(points):
    """Heights of the surface of every case, whose shortest wave has eight points."""
    return self_affine(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=20071,
        hurst=0.8,
        roll_off=SIDE / 4,
        cut_off=8 * SIDE / points,
        rms_slope=0.1,
    ).heights


def python(solver):
    """Of the project, or of the peers' environment."""
    if solver == "run_roughfilm":
        return sys.executable
    if "ROUGHFILM_PEERS" not in os.environ:
        pytest.skip("the peers are not here: make them by roughfilm/charts/peers/setup, name them in ROUGHFILM_PEERS")
    return Path(os.environ["ROUGHFILM_PEERS"]) / "bin" / "python"


def one_library(threads):
    """This very tree, and as many threads for every library."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
    return {"PYTHONPATH": str(ROOT)} | dict.fromkeys(names, str(threads))


def table(case, rows):
    """A case with all its solvers, and the peers' times over ours."""
    found = {solver: row for (name, solver), row in rows.items() if name == case.name}
    ours = found.get("run_roughfilm")
    for solver, row in found.items():
        if ours and "failed" not in row:
            row["cpu_over_ours"] = row["cpu_s"] / ours["cpu_s"]
            row["wall_over_ours"] = row["wall_s"] / ours["wall_s"]
            row["apart"] = apart(ours, row)
        alone = rows.get((case.name.removesuffix(f", {case.threads} threads"), solver))
        if case.threads > 1 and alone:
            row["speed_up"] = alone["wall_s"] / row["wall_s"]
    return {**asdict(case), "solvers": found}


def apart(ours, theirs):
    """The largest differences of area and of mean gap over the rms height, over all loads."""
    pairs = list(zip(ours["solutions"], theirs["solutions"], strict=True))
    return {
        name: max(abs(mine[name] - other[name]) for mine, other in pairs)
        for name in ("area_fraction", "plastic_fraction", "mean_gap_over_rms")
    }


@pytest.mark.benchmark
@pytest.mark.parametrize(("case", "solver"), PAIRS)
def test_a_solver_keeps_the_conditions_of_contact_and_agrees_with_ours(solved, case, solver):
    found, ours = solved(case, solver), solved(case, "run_roughfilm")
    assert "failed" not in found
    if solver == "run_roughfilm":
        assert found["violation"] <= VIOLATION
        for solution in found["solutions"]:
            assert solution["load_error"] < 1e-10
            assert solution["below_zero"] == solution["above_hardness"] == 0
    differences = apart(ours, found)
    assert differences["area_fraction"] <= AREA
    assert differences["plastic_fraction"] <= AREA
    assert differences["mean_gap_over_rms"] <= MEAN_GAP


@pytest.mark.benchmark
def test_the_time_of_writing_a_series_beside_that_of_its_contacts(tmp_path):
    points, spent = 1024, dict.fromkeys(("contact", "writing"), 0.0)
    heights = rough(points)
    press = Press(heights, (SIDE / points,) * 2, MODULUS)
    inputs = Inputs(heights=heights, spacing=press.spacing, settings={})
    loads, contact = [float(load) * MODULUS for load in np.geomspace(0.00041, 0.0355, 20)], None
    press.at(loads[0], tolerance=1e-2)
    for load in loads:
        begun = time.process_time()
        contact = press.at(load, start=contact)
        row = row_of(contact, 0.0)
        solved = time.process_time()
        add(tmp_path / "series.h5", inputs, [(row, contact)])
        spent["contact"] += solved - begun
        spent["writing"] += time.process_time() - solved
    assert sorted(finished(tmp_path / "series.h5", inputs)) == loads
    with replacing(RESULTS.with_name("contact_series.json"), JSON) as scratch:
        fraction = spent["writing"] / sum(spent.values())
        scratch.write_text(json.dumps({**circumstances(), "cpu_s": spent, "writing_fraction": fraction}, indent=1))
