"""Runs of solvers of other projects, each in its own Python environment by the programs in ``charts/peers``."""

import json
import os
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.charts.family import Measured, Peer
from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.errors import ConvergenceError, UnavailableError
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.rom.bearing.geometry.shapes import Parabolic
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus
from roughfilm.rom.parts.restriction import restricted

PROGRAMS = Path(__file__).parent / "peers"

"""Directory of the programs that run the peers."""

VIOLATION = 1e-8
"""Allowed violation of the conditions of contact over the rms height; equal to the tolerance of this project."""

TOLERANCES = {
    "run_aspher": (1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 1e-12),
    "run_tamaas": (1e-8, 3e-9, 1e-9, 1e-10, 1e-11, 1e-12),
    "run_contact_mechanics": (1e-8, 5e-9, 2e-9, 1e-9, 1e-10),
}
"""Tolerances of each contact solver, the loosest first; the first one that satisfies ``VIOLATION`` is timed."""


@dataclass(frozen=True, kw_only=True)
class Environment:
    """A Python environment of peers: the environment variable with its directory, and the program that makes it."""

    variable: str
    setup: str

    def absent(self) -> str | None:
        """The reason why the environment cannot be used, with the remedy; None if it can be used."""
        directory = os.environ.get(self.variable)
        make = f"roughfilm/charts/peers/{self.setup} DIR makes it, {self.variable}=DIR names it"
        if directory is None:
            return f"{self.variable} is not set: {make}"
        if not (Path(directory) / "bin" / "python").is_file():
            return f"{self.variable}={directory} is no Python environment: {make}"
        return None

    def run(self, program: str, *arguments: str | Path, problem: Mapping[str, Any]) -> dict[str, Any]:
        """Run PROGRAM ARGUMENTS... PROBLEM.json RESULT.json in one thread, and return the entries of RESULT.json.

        Raises
        ------
        UnavailableError
            If the environment is absent.
        ConvergenceError
            If the program stops in error or reports a failure.
        """
        if (why := self.absent()) is not None:
            raise UnavailableError(why)
        with scratch_directory() as place:
            request, result = place / "problem.json", place / "result.json"
            request.write_text(json.dumps(problem), encoding="utf-8")
            python = Path(os.environ[self.variable]) / "bin" / "python"
            ended = subprocess.run(
                [*terminate_with_parent(), python, PROGRAMS / program, *arguments, request, result],
                env=os.environ | one_thread() | {"TMPDIR": str(place)},
                capture_output=True,
                text=True,
                check=False,
            )
            if ended.returncode != 0:
                last = (ended.stderr.strip().splitlines() or ["no message"])[-1]
                raise ConvergenceError(f"{program} stopped with code {ended.returncode}: {last}")
            answer: dict[str, Any] = json.loads(result.read_text(encoding="utf-8"))
        if "failed" in answer:
            raise ConvergenceError(f"{program}: {answer['failed']}")
        return answer


CONTACT = Environment(variable="ROUGHFILM_PEERS", setup="setup")
GAPFLOW = Environment(variable="ROUGHFILM_GAPFLOW", setup="setup_gapflow")
CELLS = Environment(variable="ROUGHFILM_CELL_PEERS", setup="setup_homogenization")


def one_thread() -> dict[str, str]:
    """The environment variables that limit every numerical library to one thread, by name."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
    return dict.fromkeys(names, "1") | {"XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false"}


def contact_peers(scene: DryContact, costs: Mapping[str, Mapping[int, float]]) -> tuple[Peer, ...]:
    """The peers that solve an elastic contact; ``costs`` are CPU seconds by solver and points along a side."""
    names = {"run_aspher": "ASPHER", "run_tamaas": "Tamaas", "run_contact_mechanics": "ContactMechanics"}
    settings = (
        f"one thread, the loosest of its tolerances that breaks the conditions of contact by {VIOLATION:g} of the rms "
        "height at most, as this project's"
    )
    return tuple(
        Peer(
            name=name,
            settings=settings,
            costs=costs[solver],
            measure=partial(_mean_gap, scene, solver),
            absent=CONTACT.absent,
        )
        for solver, name in names.items()
    )


def _mean_gap(scene: DryContact, solver: str, resolution: int) -> Measured:
    surface = scene.surface()
    heights = restricted(surface.heights, (resolution, resolution))
    problem = {
        "spacing": [length / resolution for length in surface.size],
        "loads": [scene.load.pressure / scene.composite_modulus],
        "hardness": None,
        "threads": 1,
        "tolerances": TOLERANCES[solver],
        "violation": VIOLATION,
        "repeats": 3,
    }
    with scratch_directory() as place:
        path = place / "heights.npy"
        np.save(path, heights)
        answer = CONTACT.run("run.py", solver, path, problem=problem)
    if answer["violation"] > VIOLATION:
        raise ConvergenceError(f"{solver}: breaks the conditions of contact by {answer['violation']:.1e} at best")
    solution = answer["solutions"][0]
    return Measured(
        value=solution["mean_gap_over_rms"] * float(heights.std()),
        cpu_s=answer["setup_cpu_s"] + answer["cpu_s"],
        details={name: answer[name] for name in ("version", "tolerance", "violation")}
        | {name: solution[name] for name in ("iterations", "area_fraction")},
    )


def gapflow(scene: Bearing, costs: Mapping[int, float]) -> Peer:
    """The peer GaPFlow, which solves a flooded parabolic slider in a liquid of constant bulk modulus.

    ``costs`` are CPU seconds by the number of cells.
    """
    settings = (
        "explicit steps until the load stays to 1e-4, its equation of state replaced by the slider's (it has no such "
        "liquid), 3400 kg/m³ for fewer and longer steps to the same steady state"
    )
    measure = partial(_load, scene)
    return Peer(name="GaPFlow", settings=settings, costs=costs, measure=measure, absent=GAPFLOW.absent)


def _load(scene: Bearing, cells: int) -> Measured:
    shape, law = scene.geometry, scene.lubricant.compressibility
    assert isinstance(shape, Parabolic)
    assert isinstance(law, ConstantBulkModulus)
    problem = {
        "gap": "parabolic",
        "law": "cavitating",
        "density": 4 * 850.0,
        "courant": 0.4,
        "length": shape.length,
        "h_min": shape.thinnest,
        "h_max": shape.thinnest + shape.rise,
        "speed": scene.motion.speed,
        "viscosity": scene.lubricant.viscosity,
        "bulk_modulus": law.bulk_modulus,
        "steady": 1e-4,
        "cells": cells,
    }
    answer = GAPFLOW.run("run_gapflow.py", problem=problem)
    if not answer["settled"]:
        raise ConvergenceError(f"GaPFlow: the load still changes after {answer['steps']} steps")
    return Measured(
        value=answer["load"],
        cpu_s=answer["setup_cpu_s"] + answer["cpu_s"],
        details={"version": answer.get("version"), "iterations": answer["steps"], "tolerance": 1e-4},
    )
