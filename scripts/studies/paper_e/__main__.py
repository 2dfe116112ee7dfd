"""Paper E on made and measured surfaces: a thrust washer over speed and load, a leak by window and resolution, claims.

python -m scripts.studies.paper_e --out OUT. Measured surfaces with --surfaces DIR (or ROUGHFILM_SURFACES).
Source: F. Sahlin, Luleå 2008, Paper E: E.4.1 and E.4.3.
"""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import composite_modulus
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.figures.contact_view import view_of, view_picture
from roughfilm.pages.error_bars import with_error
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances, code
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from scripts.studies.study import Claim, Surfaces, tell, write_numbers
from scripts.studies.paper_e import data as paper_e_data
from scripts.studies.paper_e import windows as paper_e_windows
from scripts.studies.paper_e.claims import Paper, judge, worst_cell
from scripts.studies.paper_e.data import LOADS, SCALED, Washer
from scripts.studies.paper_e.made import POINTS, made
from scripts.studies.paper_e.windows import LOAD, MILLED, Leak, sensitivity

PRESSED, PICTURED = (2e6, 50e6, 500e6), 128
"""Loads at which the contact is pictured, Pa, and its points along a side."""


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, its figures and the numbers go here; what is finished stays.")],
    surfaces: Surfaces = None,
    as_json: AsJson = False,
) -> None:
    """Sweep the washer of Paper E on five surfaces and four lays, vary what a leak hangs on, and judge the claims."""
    from roughfilm.figures.base import svg
    from scripts.studies.paper_e import figures as paper_e_figures  # matplotlib is slow to import

    make_directory(out)
    paper = compute(out, surfaces)
    claims = judge(paper)
    plots = {name: svg(figure) for name, figure in paper_e_figures.drawings(paper).items()}
    write_figures(plots, out)
    told = numbers(paper, claims)
    write_numbers(told, out / "paper_e.json")
    render(
        Path(__file__).parent / "page.html.j2",
        out / "paper_e.html",
        plots={"leakages": None, **plots},
        claims=claims,
        rows=[_row(name, one) for name, one in paper.washers.items()],
        loads=LOADS,
        friction=paper_e_data.FRICTION,
        scaled=SCALED,
        milled=MILLED,
        load=LOAD,
        studies=studies(paper.windows) if paper.windows else [],
        contact=view_picture([view_of(contact) for contact in pressed()])[0],
    )
    tell(claims, told, out / "paper_e.html", as_json=as_json)


def compute(
    out: Path,
    surfaces: Path | None = None,
    *,
    points: int = POINTS,
    cells: int = paper_e_data.CELLS,
    speeds: Sequence[float] = paper_e_data.SPEEDS,
) -> Paper:
    """Everything that the page shows; tables, curves and leaks stay in ``out`` and are found again."""
    bodies, turned = paper_e_data.surfaces(surfaces, points), paper_e_data.lays(points)
    leaky = surfaces is not None and (surfaces / MILLED).is_file()
    parts = len(bodies) + len(turned) + leaky
    with progress_bar(parts) as bar:
        done = 0

        def advance(words: str) -> None:
            bar(done, words)

        washers: dict[str, Washer] = {}
        lays: dict[str, Washer] = {}
        for name, body in bodies.items():
            washers[name] = paper_e_data.washer(
                body, out / name, boxed=True, speeds=speeds, cells=cells, advance=advance
            )
            done += 1
        for name, body in turned.items():
            lays[name] = paper_e_data.washer(
                body, out / "lays" / name, boxed=False, speeds=paper_e_data.FEW, cells=cells, advance=advance
            )
            done += 1
        windows, rows = _kept(out / "windows.json", surfaces, advance) if leaky and surfaces is not None else ((), ())
    return Paper(windows=windows, rows=rows, washers=washers, lays=lays)


def _kept(
    path: Path, folder: Path, advance: Callable[[str], None]
) -> tuple[tuple[Leak, ...], tuple[tuple[int, float], ...]]:
    """The windows' leaks, and those in a row, from a file, if it holds those of this code and this surface."""
    asked = {
        "code": code(),
        "surface": hashlib.sha256((folder / MILLED).read_bytes()).hexdigest(),
        "loads": list(paper_e_windows.LOADS),
    }
    if path.is_file():
        held = json.loads(path.read_text(encoding="utf-8"))
        if held.get("asked") == asked:
            return tuple(_leak(entries) for entries in held["leaks"]), tuple(map(tuple, held["rows"]))
    found = paper_e_windows.study(folder, advance=advance)
    advance("windows in a row")
    rows = paper_e_windows.in_a_row(read_surface(folder / MILLED), *worst_cell(found))
    told = {"asked": asked, "leaks": [asdict(one) for one in found], "rows": rows}
    with replacing(path) as scratch:
        scratch.write_text(json.dumps(told), encoding="utf-8")
    return found, rows


def _leak(entries: Mapping[str, Any]) -> Leak:
    made: dict[str, Any] = {
        name: tuple(entries[name]) if isinstance(entries[name], list) else entries[name]
        for name in (field.name for field in fields(Leak))
    }
    return Leak(**made)


def pressed() -> list[Contact]:
    """The ground surface at the loads that are pictured."""
    surface = made("surface 3", PICTURED)
    steel = paper_e_windows.STEEL
    press = Press(surface.heights, surface.spacing, composite_modulus(steel), hardness=steel.hardness)
    return [press.at(load) for load in PRESSED]


def studies(windows: Sequence[Leak]) -> list[tuple[str, str]]:
    """In words, what each change does to the leakage along y, at the best places and over all."""

    def at(window: str, resolution: float, load: float) -> list[float]:
        return [
            one.homogenized[1]
            for one in windows
            if (one.window, one.resolution, one.load) == (window, resolution, load)
        ]

    whole = at("a", 1.0, LOAD)[0]
    told = [
        (f"{name} load, window a", f"{100 * (at('a', 1.0, factor * LOAD)[0] / whole - 1):+.3g} %")
        for name, factor in (("half", 0.5), ("double", 2.0))
    ]
    told += [
        (
            f"{name} the nodes, window {window}",
            f"{100 * (at(window, factor, LOAD)[0] / at(window, 1.0, LOAD)[0] - 1):+.3g} %",
        )
        for window in ("a", "b")
        for name, factor in (("half", 0.5), ("double", 2.0))
    ]
    for window in ("b", "c"):
        parts = np.array(at(window, 1.0, LOAD)) / whole - 1
        told.append(
            (
                f"window {window} for a, {parts.size} places",
                f"{100 * parts.mean():+.2g} % on average, {100 * parts.min():+.2g} to {100 * parts.max():+.2g} %",
            )
        )
    line = [one for one in windows if one.window == "a" and one.resolution == 1.0]
    told.append(("slope d ln Q/d ln W, window a, half to double the load", f"{sensitivity(line, 1):.2f}"))
    return told


def _row(name: str, one: Washer) -> dict[str, Any]:
    from scripts.studies.paper_e.figures import point_at

    pairs = zip(one.lift(), one.lift(boxed=True), strict=True)
    lifts = [tuple(with_error(*one) for one in pair) for pair in pairs]
    return {"name": name, "lifts": lifts, "share": point_at(one, 1, paper_e_data.SHOWN[0]).contact_share}


def numbers(paper: Paper, claims: Sequence[Claim]) -> dict[str, Any]:
    """What the page tells, as entries that JSON can hold; speeds in turns a minute."""

    def lifts(one: Washer, *, boxed: bool = False) -> list[dict[str, float]]:
        return [
            {"load": load, "speed": float(speed), "uncertainty": float(unsure)}
            for load, (speed, unsure) in zip(LOADS, one.lift(boxed=boxed), strict=True)
        ]

    return {
        "claims": [asdict(claim) for claim in claims],
        "washers": {
            name: {
                "homogenized": lifts(one),
                "patir_cheng": lifts(one, boxed=True),
                "films_apart": one.apart(),
                "table_points": one.wall.points,
                "warnings": list(one.wall.told),
            }
            for name, one in paper.washers.items()
        },
        "lays": {name: lifts(one) for name, one in paper.lays.items()},
        "windows": [asdict(one) for one in paper.windows],
        "windows_in_a_row": [{"windows": count, "direct_over_homogenized": part + 1} for count, part in paper.rows],
        "provenance": circumstances(),
    }


if __name__ == "__main__":
    run_alone(command)
