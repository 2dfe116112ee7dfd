"""CPU time of a step of an orbit, and of stiffness and damping, as JSON with the machine."""

import json
import os
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from moving_films import CLEARANCE, RADIUS, SPEED, course, journal, steady
from places import BENCHMARKS

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import JSON
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.march import begun, march
from roughfilm.rom.ladder.provenance import circumstances

RESULTS = BENCHMARKS / "motion.json"
REPEATS = 3
TURN = 2 * np.pi * RADIUS / SPEED
LOAD, ROTATING, MASS = 1e4, 3e3, 20.0
"""Constant load, N, load that turns with the shaft, N, and mass of the shaft, kg."""


def orbit(cells, turns, error):
    """CPU milliseconds per step of an orbit, sorted, with its steps per turn and iterations per step."""
    film = journal(cells, halved=True)
    start = begun(film, steady(film, [0.3 * CLEARANCE, 0.0]))

    def force(time):
        angle = 2 * np.pi * time / TURN
        return np.array([LOAD + ROTATING * np.cos(angle), ROTATING * np.sin(angle)])

    moves = course(film, force=force, mass=MASS, scale=CLEARANCE * SPEED / RADIUS)
    run = partial(march, film, moves, start, largest_step=TURN / 20, error=error)
    list(run(0.1 * TURN))
    times = []
    for _ in range(REPEATS):
        started = time.process_time()
        steps = list(run(turns * TURN))
        times.append((time.process_time() - started) / len(steps) * 1e3)
    return {
        "cells_of_half": list(cells),
        "error": error,
        "cpu_ms_per_step": sorted(times),
        "steps_per_turn": len(steps) / turns,
        "iterations_per_step": sum(step.instant.iterations for step in steps) / len(steps),
    }


def small_motion(cells):
    """CPU milliseconds of stiffness and damping, sorted."""
    film = journal(cells, halved=True)
    at = steady(film, [0.3 * CLEARANCE, -0.4 * CLEARANCE])
    times = []
    for _ in range(REPEATS + 1):
        started = time.process_time()
        coefficients(film, at, speed=SPEED)
        times.append((time.process_time() - started) * 1e3)
    return {"cells_of_half": list(cells), "cpu_ms": sorted(times[1:])}


@pytest.mark.benchmark
def test_cost_of_motion():
    orbits = [orbit(cells, 3, error) for cells in ((64, 16), (128, 32)) for error in (1e-2, 1e-3, 1e-4)]
    small = [small_motion(cells) for cells in ((64, 16), (128, 32))]
    with replacing(RESULTS, JSON) as scratch:
        scratch.write_text(json.dumps({**circumstances(), "orbits": orbits, "coefficients": small}, indent=1))
    assert max(row["cpu_ms_per_step"][0] for row in orbits if row["cells_of_half"] == [64, 16]) < 5
    assert small[-1]["cpu_ms"][0] < 20


@pytest.mark.benchmark
def test_threads_of_the_blas_cost_nothing():
    """A march from Python takes the CPU time of one whose BLAS has one thread, also where the whole width is solved."""
    program = Path(__file__).parent / "march_of_a_whole_width.py"
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    free = {name: value for name, value in os.environ.items() if name not in names}
    times = [
        float(subprocess.run([sys.executable, program], env=env, capture_output=True, check=True, text=True).stdout)
        for env in (free | dict.fromkeys(names, "1"), free)
    ]
    assert times[1] < 1.3 * times[0]
