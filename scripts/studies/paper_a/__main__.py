"""Regenerate Figures A.3 to A.15 of Paper A, find the onset of back-flow, and judge the paper's claims.

python -m scripts.studies.paper_a DIR --out OUT, where DIR holds the finished sweep of
scripts/examples/studies/paper_a.toml. Source: Sahlin et al. 2005, doi:10.1115/1.1828067.
"""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.figures.rendering import draw_apart, embedded
from roughfilm.rom.studies.sweep import read_sweep, relative_error
from roughfilm.rom.studies.table import read_table
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.paper_a import figures
from scripts.studies.paper_a.claims import judge
from scripts.studies.paper_a.data import DEPTHS, NUMBERS, SHAPES, WIDTHS, PaperA, first_zero, still_wall_shear
from scripts.studies.study import Out, counted, publish


@in_one_line
def command(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="Directory of the finished batch of paper_a.toml.")],
    out: Out,
    as_json: AsJson = False,
) -> None:
    """Draw the figures of Paper A and judge its claims."""
    paper = read_paper(directory)
    make_directory(out)
    onsets = find_onsets(paper)
    upwind = upwind_effect(paper)
    numbers = {
        "onset": [
            {"shape": name, "width_plus": width, "reynolds_number": number, "depth_plus": depth}
            for (name, width, number), depth in onsets.items()
        ],
        "upwind": upwind,
    }
    publish(
        Path(__file__).parent,
        out,
        {name: draw(paper) for name, draw in figures.DRAWINGS.items()} | {"onset": figures.onset(paper, onsets)},
        numbers,
        claims=judge(paper, onsets),
        as_json=as_json,
        pictures=_streamlines(paper, out),
        upwind=upwind,
    )


def read_paper(directory: Path) -> PaperA:
    """Return the sweep with its settings for Navier-Stokes (second order and upwind) and for Stokes flow."""
    sweep = read_sweep(read_table(directory / "table.h5"), "pocket")

    def setting(model: str, scheme: str | None = None) -> str | None:
        known = (name.split("-") for name in sweep.found)
        return next(("-".join(parts) for parts in known if parts[0] == model and scheme in (None, parts[-1])), None)

    best = setting("navier_stokes", "linear_upwind") or setting("navier_stokes", "navier_stokes")
    stokes = setting("stokes")
    if best is None or stokes is None or "film_slope" not in sweep.found:
        raise InputError(f"{directory}: lacks results of navier_stokes, stokes or film_slope; run paper_a.toml there")
    upwind = setting("navier_stokes", "upwind")
    return PaperA(sweep=sweep, directory=directory, best=best, stokes=stokes, upwind=upwind)


def find_onsets(paper: PaperA) -> dict[tuple[str, float, float], float]:
    """Return the depth d+ at which the shear on the still wall first reverses, by shape, w+ and Re."""
    onsets = {}
    keys = list(product(SHAPES.items(), WIDTHS, NUMBERS))
    with counted(len(keys)) as advance:
        for (name, shape), width, number in keys:
            advance("looking for back-flow")
            shear = [
                still_wall_shear(paper.result(paper.rows(shape, width=width, depth=depth, number=number), paper.best))
                for depth in DEPTHS
            ]
            onsets[name, width, number] = first_zero(np.array(DEPTHS), np.array(shear))
    return onsets


def upwind_effect(paper: PaperA) -> list[dict[str, Any]]:
    """Return the relative difference of load and friction between first-order upwind and second order, for each Re."""
    if paper.upwind is None:
        return []
    rows = []
    for number in NUMBERS:
        chosen = np.isclose(paper.sweep.given["reynolds_number"], number)
        load, friction = (
            relative_error(paper.sweep, paper.upwind, paper.best, quantity)[chosen]
            for quantity in ("load_plus", "friction_plus")
        )
        worst = {"load_worst": float(np.nanmax(load)), "friction_worst": float(np.nanmax(friction))}
        rows.append({"reynolds_number": number, "load_median": float(np.nanmedian(load)), **worst})
    return rows


def _streamlines(paper: PaperA, out: Path) -> Mapping[str, list[tuple[str, str]]]:
    """Return title and data of every picture; without data, and with the reason in the title, where drawing failed."""
    wanted = figures.STREAMLINES

    def picture(job: tuple[str, int, tuple[str, str, float, float, float]]) -> tuple[str, str, str]:
        name, place, (title, model, width, depth, number) = job
        rows = paper.rows(SHAPES["cylindrical"], width=width, depth=depth, number=number)
        path = out / f"{name}{'abcd'[place]}.png"
        drawn = draw_apart(
            "roughfilm.figures.streamlines",
            paper.path(rows, paper.best if model == "navier_stokes" else paper.stokes),
            path,
        )
        if not drawn.available:
            return name, f"{title}: no picture: {drawn.detail}", ""
        return name, title, embedded(path)

    jobs = [(name, place, case) for name, cases in wanted.items() for place, case in enumerate(cases)]
    pictures: dict[str, list[tuple[str, str]]] = {name: [] for name in wanted}
    with ThreadPoolExecutor() as pool, counted(len(jobs)) as advance:
        for name, title, data in pool.map(picture, jobs):
            advance("drawing streamlines")
            pictures[name].append((title, data))
    return pictures


if __name__ == "__main__":
    run_alone(command)
