"""Runs of simpleFoam with the schemes, solvers, relaxation and stopping criteria of its tutorial ``pitzDaily``."""

import json
import re
import time
from collections.abc import Mapping
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path

import numpy as np

from roughfilm.charts.family import Measured, Peer
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.foamcases.openfoam.block_mesh import write_block
from roughfilm.foamcases.openfoam.case_directory import CARD, read_card
from roughfilm.foamcases.openfoam.dictionaries import SIDES, Dictionary, control, write_files
from roughfilm.foamcases.openfoam.installation import availability
from roughfilm.foamcases.openfoam.program import Ended, succeed
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.fields import read_channel
from roughfilm.foamcases.pocket.models.navier_stokes import MODEL as NAVIER_STOKES
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities

NAME = "simpleFoam, tutorial"
TUTORIAL = "pitzDaily"
ITERATIONS = 2000

LINEAR = ("Gauss", "linear")

SETTINGS: Mapping[str, Dictionary] = {
    "system/controlDict": control(ITERATIONS),
    "system/fvSchemes": (
        "dictionary",
        {
            "ddtSchemes": {"default": "steadyState"},
            "gradSchemes": {"default": LINEAR},
            "divSchemes": {
                "default": "none",
                "div(phi,U)": ("bounded", "Gauss", "linearUpwind", "grad(U)"),
                "div((nuEff*dev2(T(grad(U)))))": LINEAR,
            },
            "laplacianSchemes": {"default": (*LINEAR, "corrected")},
            "interpolationSchemes": {"default": "linear"},
            "snGradSchemes": {"default": "corrected"},
        },
    ),
    "system/fvSolution": (
        "dictionary",
        {
            "solvers": {
                "p": {"solver": "GAMG", "smoother": "GaussSeidel", "tolerance": 1e-6, "relTol": 0.1},
                "U": {"solver": "smoothSolver", "smoother": "symGaussSeidel", "tolerance": 1e-5, "relTol": 0.1},
            },
            "SIMPLE": {
                "nNonOrthogonalCorrectors": 0,
                "consistent": True,
                "pRefCell": 0,
                "pRefValue": 0,
                "residualControl": {"p": 1e-2, "U": 1e-3},
            },
            "relaxationFactors": {"equations": {"U": 0.9}},
        },
    ),
}
"""Settings of tutorials/incompressible/simpleFoam/pitzDaily from OpenFOAM v1606 on, without turbulence, and with a
reference pressure, which a periodic flow needs."""

_CONVERGED = re.compile(r"SIMPLE solution converged in (\d+) iterations")


def absent() -> str | None:
    """The reason why OpenFOAM is not available on this machine; None if it is available."""
    here = availability()
    return None if here.available else here.detail


def run(directory: Path) -> tuple[Ended, int]:
    """Run simpleFoam with the tutorial's settings in a case directory.

    Returns
    -------
    Ended, int
        The ended program, and the number of iterations.

    Raises
    ------
    ConvergenceError
        If simpleFoam stops in error, or does not reach the tolerances of the tutorial.
    """
    for name in SETTINGS:
        (directory / name).unlink()  # entries of the existing file would remain otherwise
    write_files(directory, SETTINGS)
    ended = succeed(directory, ["simpleFoam"], "log.simpleFoam")
    converged = _CONVERGED.search(ended.log)
    if converged is None:
        message = f"simpleFoam with the settings of {TUTORIAL}: not converged after {ITERATIONS} iterations"
        raise ConvergenceError(message, outcome=Outcome.UNFINISHED, iterations=ITERATIONS)
    return ended, int(converged[1])


def uniform(scene: Pocket, columns: int, layers: int) -> Array:
    """The vertices of a mesh with uniform columns, over the film thickness, shape (columns + 1, layers + 1, 2, 3)."""
    gap = scene.gap()
    x = np.linspace(gap.breaks[0], gap.breaks[-1], columns + 1)
    h = gap.thickness(x) / gap.film
    vertices = np.empty((columns + 1, layers + 1, 2, 3))
    vertices[..., 0] = (x / gap.film)[:, None, None]
    vertices[..., 1] = (1 - h[:, None] * (1 - np.linspace(0, 1, layers + 1)))[:, :, None]
    vertices[..., 2] = [0.0, 1.0]
    return vertices


def pocket_load(scene: Pocket, resolution: int) -> Measured:
    """The load+ of a pocket on uniform columns, with as many layers as this project's own mesh; raises as ``run``."""
    with scratch_directory() as place:
        directory = place / "case"
        NAVIER_STOKES.write(scene, directory, Request(resolution=resolution))
        started = time.thread_time()
        card = replace(read_card(directory, Card), columns=resolution)
        (directory / CARD).write_text(json.dumps(asdict(card)), encoding="utf-8")
        write_block(uniform(scene, resolution, card.layers), SIDES, directory)
        ended, iterations = run(directory)
        channel = read_channel(directory)
        least, greatest = channel.pressure_range(0.0)
        quantities = pocket_quantities(
            scene,
            load=channel.mean(channel.wall_pressure),
            friction=channel.mean(channel.wall_shear),
            pressure_max=greatest,
            pressure_min=least,
            backflow=channel.back_flow(),
            parts=channel.wall_pressure.size,
        )
        spent = time.thread_time() - started
    return Measured(
        value=quantities["load_plus"].value,
        cpu_s=ended.cpu_s + spent,
        details={"version": availability().detail, "iterations": iterations},
    )


def on_pocket(scene: Pocket, costs: Mapping[int, float]) -> Peer:
    """The peer that solves a pocket with the tutorial's settings; ``costs`` are CPU seconds by mesh columns."""
    settings = (
        f"uniform columns, as blockMesh makes them; schemes, linear solvers, relaxation (0.9, SIMPLEC) and stopping "
        f"(residuals 1e-2 of p, 1e-3 of U) of the tutorial {TUTORIAL}"
    )
    return Peer(name=NAME, settings=settings, costs=costs, measure=partial(pocket_load, scene), absent=absent)
