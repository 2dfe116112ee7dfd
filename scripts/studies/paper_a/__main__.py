"""Figures A.3 to A.15 of the source, the onset of back-flow, and its claims judged, from one sweep on one page.

python -m scripts.studies.paper_a DIR --out OUT, where DIR holds the finished study
scripts/examples/studies/paper_a.toml. Source: Sahlin et al. 2005, doi:10.1115/1.1828067.
"""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from itertools import product
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from roughfilm.contact.foundation.errors import InputError
from roughfilm.figures.rendering import draw_apart, embedded
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.studies.sweep import read_sweep, relative_error
from roughfilm.rom.studies.table import read_table
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from scripts.studies.claims import Claim, tell, write_numbers
from scripts.studies.paper_a.claims import judge
from scripts.studies.paper_a.data import DEPTHS, NUMBERS, SHAPES, WIDTHS, Paper, first_zero, still_wall_shear


@in_one_line
def command(
    directory: Annotated[Path, typer.Argument(metavar="DIR", help="What 'roughfilm batch' made of paper_a.toml.")],
    out: Annotated[Path, typer.Option(help="The page, and every figure by its number, go here.")],
    as_json: AsJson = False,
) -> None:
    """Draw the figures of Paper A and judge its claims."""
    from roughfilm.figures.base import svg
    from scripts.studies.paper_a import figures as paper_a_figures  # matplotlib is slow to import

    paper = read_paper(directory)
    make_directory(out)
    onsets = find_onsets(paper)
    claims = judge(paper, onsets)
    figures = {name: draw(paper) for name, draw in paper_a_figures.NUMBERED.items()}
    figures |= {"onset": paper_a_figures.onset(paper, onsets), "scheme": paper_a_figures.scheme(paper)}
    plots = {name: svg(figure) for name, figure in figures.items()}
    write_figures(plots, out)
    pictures = _streamlines(paper, paper_a_figures.STREAMLINES, out)
    told = {
        "claims": [asdict(claim) for claim in claims],
        "onset": [
            {
                "shape": name,
                "width_plus": width,
                "reynolds_number": number,
                "depth_plus": depth if np.isfinite(depth) else None,
            }
            for (name, width, number), depth in onsets.items()
        ],
        "upwind": upwind_effect(paper),
    }
    write_numbers(told, out / "paper_a.json")
    _write_page(plots, pictures, claims, told["upwind"], out / "paper_a.html")
    tell(claims, told, out / "paper_a.html", as_json=as_json)


def read_paper(directory: Path) -> Paper:
    """The sweep with the settings that stand for Navier-Stokes at second order, with upwind, and Stokes."""
    sweep = read_sweep(read_table(directory / "table.h5"), "pocket")

    def setting(model: str, scheme: str | None = None) -> str | None:
        known = (name.split("-") for name in sweep.found)
        return next(("-".join(parts) for parts in known if parts[0] == model and scheme in (None, parts[-1])), None)

    best = setting("navier_stokes", "linear_upwind") or setting("navier_stokes", "navier_stokes")
    stokes = setting("stokes")
    if best is None or stokes is None or "film_slope" not in sweep.found:
        raise InputError(f"{directory}: lacks results of navier_stokes, stokes or film_slope; run paper_a.toml there")
    upwind = setting("navier_stokes", "upwind")
    return Paper(sweep=sweep, directory=directory, best=best, stokes=stokes, upwind=upwind)


def find_onsets(paper: Paper) -> dict[tuple[str, float, float], float]:
    """The depth d+ at which the shear on the still wall first turns, by shape, w+ and Re."""
    onsets = {}
    keys = list(product(SHAPES.items(), WIDTHS, NUMBERS))
    with progress_bar(len(keys)) as advance:
        for done, ((name, shape), width, number) in enumerate(keys):
            advance(done, "looking for back-flow")
            shear = [
                still_wall_shear(paper.result(paper.rows(shape, width=width, depth=depth, number=number), paper.best))
                for depth in DEPTHS
            ]
            onsets[name, width, number] = first_zero(np.array(DEPTHS), np.array(shear))
    return onsets


def upwind_effect(paper: Paper) -> list[dict[str, Any]]:
    """By Re, how far load and friction by first-order upwind are from second order on the same meshes."""
    if paper.upwind is None:
        return []
    rows = []
    for number in NUMBERS:
        chosen = np.isclose(paper.sweep.given["reynolds_number"], number)
        load, friction = (
            relative_error(paper.sweep, paper.upwind, paper.best, quantity)[chosen]
            for quantity in ("load_plus", "friction_plus")
        )
        rows.append(
            {
                "reynolds_number": number,
                "load_median": float(np.nanmedian(load)),
                "load_worst": float(np.nanmax(load)),
                "friction_worst": float(np.nanmax(friction)),
            }
        )
    return rows


def _streamlines(
    paper: Paper, wanted: dict[str, tuple[tuple[str, str, float, float, float], ...]], out: Path
) -> dict[str, list[tuple[str, str]]]:
    """Every picture as title and data, empty with the reason in the title where it could not be drawn."""

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
    with ThreadPoolExecutor() as pool, progress_bar(len(jobs)) as advance:
        for done, (name, title, data) in enumerate(pool.map(picture, jobs)):
            advance(done + 1, "drawing streamlines")
            pictures[name].append((title, data))
    return pictures


def _write_page(
    plots: dict[str, str],
    pictures: dict[str, list[tuple[str, str]]],
    claims: list[Claim],
    upwind: list[dict[str, Any]],
    path: Path,
) -> None:
    from scripts.studies.paper_a.figures import NUMBERED

    render(
        Path(__file__).parent / "page.html.j2",
        path,
        plots=plots,
        captions={name: str(draw.__doc__) for name, draw in NUMBERED.items()},
        pictures=pictures,
        claims=claims,
        upwind=upwind,
    )


if __name__ == "__main__":
    run_alone(command)
