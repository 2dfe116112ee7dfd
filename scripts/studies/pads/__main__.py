"""Chart where inertia adds load to textured pads and where it takes it, and judge the claims of Dobrica and Fillon.

python -m scripts.studies.pads --out OUT. Results are kept in OUT/found: the same command continues an interrupted run.
Source: M. B. Dobrica and M. Fillon 2009, doi:10.1243/13506501JET433.
"""

from pathlib import Path
from typing import Any

from roughfilm.batch.executors import local
from roughfilm.ladder import find
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.request import Request
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.pads import figures
from scripts.studies.pads.claims import judge, reduced, relative
from scripts.studies.pads.data import Pad, PadStudy, Plan
from scripts.studies.runs import FOUND, Place, answers
from scripts.studies.study import Out, publish

DRAWN = {
    "inlet half, λ = 24, Re = 20": Pad(texture="inlet half", depth=1.0, rise=0.0, ratio=24.0, number=20.0),
    "inlet half, λ = 8, Re = 200": Pad(texture="inlet half", depth=1.0, rise=0.0, ratio=8.0, number=200.0),
    "full, λ = 8, Re = 200": Pad(texture="full", depth=1.0, rise=0.0, ratio=8.0, number=200.0),
}
"""The pads whose pressure is drawn."""


@in_one_line
def command(out: Out, as_json: AsJson = False) -> None:
    """Solve textured pads over Reynolds number and aspect ratio, and judge two claims about their inertia."""
    write(out, compute(out / FOUND), as_json=as_json)


def compute(folder: Path, plan: Plan | None = None, place: Place = local) -> PadStudy:
    """Solve the pads, or read their results from ``folder``."""
    plan = Plan() if plan is None else plan
    make_directory(folder)
    found, _ = answers(plan.runs(), folder, place)
    return PadStudy(plan=plan, found=found)


def write(out: Path, study: PadStudy, *, as_json: bool) -> None:
    """Write the page, its figures and its numbers."""
    publish(
        Path(__file__).parent,
        out,
        {
            "partial": figures.partial(study),
            "full": figures.full(study),
            "collapsed": figures.collapsed(study),
            "pressures": figures.pressures(
                {title: _pressures(pad) for title, pad in DRAWN.items()},
                lambda title: DRAWN[title].load_unit / DRAWN[title].length,
            ),
        },
        numbers(study),
        claims=judge(study),
        as_json=as_json,
        checks=checks(study),
    )


def _pressures(pad: Pad) -> dict[str, Any]:
    models = {"reynolds": 2048, "film_slope": 800}
    return {name: find("bearing", name).solve(pad.scene(), Request(resolution=cells)) for name, cells in models.items()}


def checks(study: PadStudy) -> list[dict[str, Any]]:
    """The loads over 6 η u L²/h² of the pads that are solved by the Navier-Stokes equations, by each model.

    ``mesh`` is the change of that by the Navier-Stokes equations from the coarser mesh over it.
    """
    return [
        {
            "texture": pad.texture,
            "rise": pad.rise,
            "ratio": pad.ratio,
            "number": pad.number,
            "reynolds": study.without(pad),
            "film": study.load(pad, "film"),
            "film_slope": study.load(pad, "film_slope"),
            "navier_stokes": load,
            "mesh": change / abs(load),
        }
        for pad, (load, change) in study.checked.items()
    ]


def numbers(study: PadStudy) -> dict[str, Any]:
    """The numbers of the page: loads over 6 η u L²/h² by map, shape (ratios, numbers)."""
    return {
        "ratios": study.plan.ratios,
        "reynolds_numbers": study.plan.numbers,
        "reduced_numbers": reduced(study),
        "maps": [
            {
                "texture": name[0],
                "depth": name[1],
                "rise": name[2],
                "reynolds": study.map(name, study.without),
                "film": study.map(name, lambda pad: study.load(pad, "film")),
                "film_slope": study.map(name, lambda pad: study.load(pad, "film_slope")),
                "by_inertia": study.map(name, study.by_inertia),
                "relative": relative(study, name),
            }
            for name in study.plan.maps()
        ],
        "cells": [
            {"depth": depth, "by_inertia": study.map((texture, depth, rise), study.by_cells)}
            for texture, depth, rise in study.plan.maps()
            if texture == "full" and rise == 0
        ],
        "checks": checks(study),
        "provenance": circumstances(),
    }


if __name__ == "__main__":
    run_alone(command)
