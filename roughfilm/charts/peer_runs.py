"""Solvers of other projects, each run in a Python of its own by the programs in ``charts/peers``."""

import json
import os
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from roughfilm.charts.family import Measured, Peer
from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.errors import ConvergenceError, UnavailableError
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shapes import Parabolic
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus
from roughfilm.rom.parts.restriction import restricted

PROGRAMS = Path(__file__).parent / "peers"

VIOLATION = 1e-8
"""By how much a contact may break its conditions, over the rms height: as this project's own solver asks of itself."""

TOLERANCES = {
    "run_aspher": (1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 1e-12),
    "run_tamaas": (1e-8, 3e-9, 1e-9, 1e-10, 1e-11, 1e-12),
    "run_contact_mechanics": (1e-8, 5e-9, 2e-9, 1e-9, 1e-10),
}
"""Each contact solver's own, the loosest first: the first that brings the violation down to what is asked is timed."""


@dataclass(frozen=True, kw_only=True)
class Environment:
    """Where some peers are installed: the variable that names its directory, and the program that makes it."""

    variable: str
    setup: str

    def absent(self) -> str | None:
        """Why nothing can be run there, with the remedy; None where it can."""
        directory = os.environ.get(self.variable)
        make = f"roughfilm/charts/peers/{self.setup} DIR makes it, {self.variable}=DIR names it"
        if directory is None:
            return f"{self.variable} is not set: {make}"
        if not (Path(directory) / "bin" / "python").is_file():
            return f"{self.variable}={directory} is no environment of Python: {make}"
        return None

    def run(self, program: str, *arguments: str | Path, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Run PROGRAM ARGUMENTS... ASKED.json RESULT.json in one thread and read what it wrote.

        Raises
        ------
        UnavailableError
            If the environment is not here.
        ConvergenceError
            If the program stops in error, or says that it failed.
        """
        if (why := self.absent()) is not None:
            raise UnavailableError(why)
        with TemporaryDirectory(prefix="roughfilm-") as place:
            request, result = Path(place) / "asked.json", Path(place) / "result.json"
            request.write_text(json.dumps(asked), encoding="utf-8")
            python = Path(os.environ[self.variable]) / "bin" / "python"
            ended = subprocess.run(
                [*terminate_with_parent(), python, PROGRAMS / program, *arguments, request, result],
                env=os.environ | one_thread(),
                capture_output=True,
                text=True,
                check=False,
            )
            if ended.returncode != 0:
                last = (ended.stderr.strip().splitlines() or ["no word"])[-1]
                raise ConvergenceError(f"{program} stopped with code {ended.returncode}: {last}")
            found: dict[str, Any] = json.loads(result.read_text(encoding="utf-8"))
        if "failed" in found:
            raise ConvergenceError(f"{program}: {found['failed']}")
        return found


CONTACT = Environment(variable="ROUGHFILM_PEERS", setup="setup")
GAPFLOW = Environment(variable="ROUGHFILM_GAPFLOW", setup="setup_gapflow")
CELLS = Environment(variable="ROUGHFILM_CELL_PEERS", setup="setup_homogenization")


def one_thread() -> dict[str, str]:
    """For every library that would take more."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
    return dict.fromkeys(names, "1") | {"XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false"}


def peer(
    environment: Environment,
    name: str,
    settings: str,
    costs: Mapping[int, float],
    measure: Callable[[int], Measured],
) -> Peer:
    """A peer that is there where its environment is."""
    return Peer(name=name, settings=settings, costs=costs, measure=measure, absent=environment.absent)


def contact_peers(scene: DryContact, costs: Mapping[str, Mapping[int, float]]) -> tuple[Peer, ...]:
    """Who presses the very heights of an elastic contact; ``costs`` by solver."""
    names = {"run_aspher": "ASPHER", "run_tamaas": "Tamaas", "run_contact_mechanics": "ContactMechanics"}
    settings = (
        f"one thread, the loosest of its tolerances that breaks the conditions of contact by {VIOLATION:g} of the rms "
        "height at most, as this project's"
    )
    return tuple(
        peer(CONTACT, name, settings, costs[solver], partial(_mean_gap, scene, solver))
        for solver, name in names.items()
    )


def _mean_gap(scene: DryContact, solver: str, resolution: int) -> Measured:
    surface = scene.surface()
    heights = restricted(surface.heights, (resolution, resolution))
    asked = {
        "spacing": [length / resolution for length in surface.size],
        "loads": [scene.load.pressure / scene.composite_modulus],
        "hardness": None,
        "threads": 1,
        "tolerances": TOLERANCES[solver],
        "violation": VIOLATION,
        "repeats": 3,
    }
    with TemporaryDirectory(prefix="roughfilm-") as place:
        path = Path(place) / "heights.npy"
        np.save(path, heights)
        found = CONTACT.run("run.py", solver, path, asked=asked)
    if found["violation"] > VIOLATION:
        raise ConvergenceError(f"{solver}: breaks the conditions of contact by {found['violation']:.1e} at best")
    only = found["solutions"][0]
    return Measured(
        value=only["mean_gap_over_rms"] * float(heights.std()),
        cpu_s=found["setup_cpu_s"] + found["cpu_s"],
        told={name: found[name] for name in ("version", "tolerance", "violation")}
        | {name: only[name] for name in ("iterations", "area_fraction")},
    )


def gapflow(scene: Bearing, costs: Mapping[int, float]) -> Peer:
    """GaPFlow on a parabolic slider in a liquid of constant bulk modulus, flooded at the pressure of cavitation."""
    settings = (
        "explicit steps until the load stays to 1e-4, its equation of state replaced by the slider's (it has no such "
        "liquid), 3400 kg/m³ for fewer and longer steps to the same steady state"
    )
    return peer(GAPFLOW, "GaPFlow", settings, costs, partial(_load, scene))


def _load(scene: Bearing, cells: int) -> Measured:
    shape, law = scene.geometry, scene.lubricant.compressibility
    assert isinstance(shape, Parabolic)
    assert isinstance(law, ConstantBulkModulus)
    asked = {
        "gap": "parabolic",
        "law": "cavitating",
        "density": 4 * 850.0,
        "courant": 0.4,
        "length": shape.length,
        "h_min": shape.film,
        "h_max": shape.film + shape.rise,
        "speed": scene.motion.speed,
        "viscosity": scene.lubricant.viscosity,
        "bulk_modulus": law.bulk_modulus,
        "steady": 1e-4,
        "cells": cells,
    }
    found = GAPFLOW.run("run_gapflow.py", asked=asked)
    if not found["settled"]:
        raise ConvergenceError(f"GaPFlow: the load still changes after {found['steps']} steps")
    return Measured(
        value=found["load"],
        cpu_s=found["setup_cpu_s"] + found["cpu_s"],
        told={"version": found.get("version"), "iterations": found["steps"], "tolerance": 1e-4},
    )
