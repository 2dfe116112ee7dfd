"""GaPFlow: explicit MacCormack steps of the gap-averaged balances of mass and momentum, until the load settles.

A program for its own Python: run_gapflow.py PROBLEM.json RESULT.json. Its release has no other way to a steady state.
"""

import contextlib
import io
import json
import logging
import sys
import time
from importlib import metadata
from pathlib import Path

import numpy as np
from GaPFlow import Problem
from GaPFlow.models import stress

NAME = "GaPFlow"
SAMPLES = 16
"""Samples of the load while the wall passes the slider once."""

SETTLED_SAMPLES = 5
"""Number of successive samples that must agree within the tolerance."""

MAX_PASSAGES = 6
"""Number of passages of the wall after which a changing load is an error."""

MURNAGHAN_EXPONENT = 1e-6
"""Exponent for which Murnaghan's law is that of a constant bulk modulus to 1e-7 of the pressure."""

VAPOUR = {"rho_v": 0.019, "c_v": 352.0}
"""GaPFlow's own, for a liquid of 850 kg/m³; scaled so that another density leaves the steady state as it is."""

TEXT = """
options: {{silent: True, write_freq: 1000000000}}
grid:
    Lx: {length!r}
    Ly: 1.
    Nx: {cells}
    Ny: 1
    xW: [D, N, N]
    xE: [D, N, N]
    xW_D: {density!r}
    xE_D: {density!r}
geometry: {{type: {gap}, hmin: {h_min!r}, hmax: {h_max!r}, U: {speed!r}, V: 0.}}
numerics: {{adaptive: 0, dt: {step!r}, tol: 0., max_it: 0}}
properties: {{shear: {viscosity!r}, bulk: 0., {equation}}}
"""
LAWS = {
    "liquid": "EOS: MT, rho0: {density!r}, P0: 0., K: {bulk_modulus!r}, n: {weak!r}",
    "cavitating": "EOS: MT, rho0: {density!r}, P0: 0., K: {bulk_modulus!r}, n: {weak!r}",
    "bayada": "EOS: Bayada, rho0: {density!r}, rho_l: {density!r}, c_l: {sound!r}, rho_v: {rho_v!r}, c_v: {c_v!r}",
}


def solve(problem):
    """Steps from the undisturbed film until the load settles; pressures and load are above the cavitation pressure."""
    sound = (problem["bulk_modulus"] / problem["density"]) ** 0.5
    spacing = problem["length"] / problem["cells"]
    friction = 12 * problem["viscosity"] / (problem["density"] * problem["h_min"] ** 2)
    step = min(problem["courant"] * spacing / sound, 1 / friction)
    zero = 0.0
    values = problem | {"step": step, "sound": sound, "weak": MURNAGHAN_EXPONENT} | vapour(problem["density"])
    if problem["law"] == "bayada":
        zero = float(stress.eos_pressure(problem["density"], bayada(values)))
    with law(problem["law"]):
        started = time.process_time()
        run = made(TEXT.format(**values, equation=LAWS[problem["law"]].format(**values)))
        run.run(keep_open=True)
        setup, started = time.process_time() - started, time.process_time()
        passage = problem["length"] / problem["speed"]
        loads, settled = [], False
        while not settled and run.simtime < MAX_PASSAGES * passage:
            run.max_it = run.step + max(1, round(passage / SAMPLES / step))
            run.run(keep_open=True)
            if run.step < run.max_it:
                return {"failed": f"not a number or a negative density after {run.step} steps", "steps": run.step}
            pressure = run.pressure.pressure[1:-1, 1] - zero
            loads.append(float(pressure.sum() * spacing))
            last = loads[-SETTLED_SAMPLES:]
            settled = len(last) == SETTLED_SAMPLES and max(last) - min(last) <= problem["steady"] * abs(last[-1])
        cpu = time.process_time() - started
    return {
        "setup_cpu_s": setup,
        "cpu_s": cpu,
        "load": loads[-1],
        "pressure_max": float(pressure.max()),
        "cells": problem["cells"],
        "steps": run.step,
        "time_s": float(run.simtime),
        "time_step_s": step,
        "settled": settled,
    }


def made(text):
    with contextlib.redirect_stdout(io.StringIO()):
        return Problem.from_string(text)


def vapour(density):
    """Sound in it is slower where the liquid is heavier: the pressures stay."""
    heavier = density / 850.0
    return {"rho_v": VAPOUR["rho_v"] * heavier, "c_v": VAPOUR["c_v"] / heavier**0.5}


def bayada(values):
    return {"EOS": "Bayada", "rho_l": values["density"], "c_l": values["sound"], **vapour(values["density"])}


@contextlib.contextmanager
def law(name):
    """GaPFlow has no liquid whose pressure stays where it cavitates: this one takes the place of its own laws."""
    kept = stress.eos_pressure, stress.eos_sound_velocity
    if name == "cavitating":
        stress.eos_pressure = lambda density, prop: prop["K"] * np.log(np.maximum(density / prop["rho0"], 1.0))
        stress.eos_sound_velocity = lambda density, prop: np.full_like(density, (prop["K"] / prop["rho0"]) ** 0.5)
    try:
        yield
    finally:
        stress.eos_pressure, stress.eos_sound_velocity = kept


def main():
    problem, result = sys.argv[1:]
    logging.getLogger("gapflow.problem").setLevel(logging.ERROR)
    found = solve(json.loads(Path(problem).read_text()))
    Path(result).write_text(json.dumps({"version": metadata.version(NAME), **found}))


if __name__ == "__main__":
    main()
