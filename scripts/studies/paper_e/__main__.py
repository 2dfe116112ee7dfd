"""Regenerate the figures of Paper E for synthetic and measured surfaces, and judge its claims on washer and leak.

python -m scripts.studies.paper_e --out OUT. Measured surfaces with --surfaces DIR (or ROUGHFILM_SURFACES).
Source: F. Sahlin, Luleå 2008, Paper E: E.4.1 and E.4.3.
"""

import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.gap_map import gap_map
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import composite_modulus
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.figures.spatial.pressed_surface import view_picture
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from roughfilm.words.numbers import with_error
from scripts.studies.paper_e import data, figures, windows
from scripts.studies.paper_e.claims import PaperE, judge, worst_cell
from scripts.studies.paper_e.data import LOADS, Washer, washer
from scripts.studies.paper_e.made import POINTS, made
from scripts.studies.paper_e.windows import LOAD, MILLED, STEEL, Leak, sensitivity
from scripts.studies.study import Out, Surfaces, kept, publish

PICTURED_LOADS, PICTURED_POINTS = (2e6, 50e6, 500e6), 128
"""Loads, Pa, and points along a side of the pictures of the contact."""


@in_one_line
def command(out: Out, surfaces: Surfaces = None, as_json: AsJson = False) -> None:
    """Sweep the washer of Paper E on five surfaces and four lays, vary the inputs of a leak, and judge the claims."""
    make_directory(out)
    paper = compute(out, surfaces)
    publish(
        Path(__file__).parent,
        out,
        figures.drawings(paper),
        numbers(paper),
        claims=judge(paper),
        as_json=as_json,
        rows=[_row(name, one) for name, one in paper.washers.items()],
        loads=LOADS,
        friction=data.FRICTION,
        scaled=data.SCALED,
        milled=MILLED,
        load=LOAD,
        studies=studies(paper.windows) if paper.windows else [],
        contact=view_picture([gap_map(contact) for contact in pressed()])[0],
    )


def compute(
    out: Path,
    surfaces: Path | None = None,
    *,
    points: int = POINTS,
    cells: int = data.CELLS,
    speeds: Sequence[float] = data.SPEEDS,
) -> PaperE:
    """Compute all data of the page; tables, curves and leaks are stored in ``out`` for the next run."""
    jobs = [(name, body, True, speeds) for name, body in data.surfaces(surfaces, points).items()]
    jobs += [(f"lays/{name}", body, False, data.FEW_SPEEDS) for name, body in data.lays(points).items()]
    milled = None if surfaces is None else surfaces / MILLED
    with progress_bar(len(jobs) + 1) as bar:
        done: dict[str, Washer] = {}
        leaks: tuple[Leak, ...] = ()
        rows: tuple[tuple[int, float], ...] = ()

        def advance(words: str) -> None:
            bar(len(done), words)

        for name, body, boxed, asked in jobs:
            done[name] = washer(body, out / name, boxed=boxed, speeds=asked, cells=cells, advance=advance)
        if milled is not None and milled.is_file():
            leaks, rows = _leaks(out / "windows.json", milled, advance)
    lays = {name.removeprefix("lays/"): one for name, one in done.items() if name.startswith("lays/")}
    washers = {name: one for name, one in done.items() if not name.startswith("lays/")}
    return PaperE(windows=leaks, rows=rows, washers=washers, lays=lays)


def _leaks(
    path: Path, milled: Path, advance: Callable[[str], None]
) -> tuple[tuple[Leak, ...], tuple[tuple[int, float], ...]]:
    """Return the leaks of the windows and of windows in a row; they are stored in a file."""

    def make() -> dict[str, Any]:
        found = windows.study(milled.parent, advance=advance)
        advance("windows in a row")
        return {"leaks": found, "rows": windows.in_a_row(read_surface(milled), *worst_cell(found))}

    inputs = {"surface": hashlib.sha256(milled.read_bytes()).hexdigest(), "loads": list(windows.LOADS)}
    held = kept(path, inputs, make)
    leaks: list[dict[str, Any]] = [
        {name: tuple(v) if isinstance(v, list) else v for name, v in one.items()} for one in held["leaks"]
    ]
    return tuple(Leak(**one) for one in leaks), tuple((count, more) for count, more in held["rows"])


def pressed() -> list[Contact]:
    """Return the contacts of the ground surface at the loads of the pictures."""
    surface = made("surface 3", PICTURED_POINTS)
    press = Press(surface.heights, surface.spacing, composite_modulus(STEEL), hardness=STEEL.hardness)
    return [press.at(load) for load in PICTURED_LOADS]


def studies(leaks: Sequence[Leak]) -> list[tuple[str, str]]:
    """Return sentences on the change of the leakage along y with load, number of nodes and window."""

    def at(window: str, resolution: float, load: float) -> list[float]:
        return [
            one.homogenized[1] for one in leaks if (one.window, one.resolution, one.load) == (window, resolution, load)
        ]

    whole = at("a", 1.0, LOAD)[0]
    changes = [
        (f"{name} load, window a", f"{100 * (at('a', 1.0, factor * LOAD)[0] / whole - 1):+.3g} %")
        for name, factor in (("half", 0.5), ("double", 2.0))
    ]
    changes += [
        (
            f"{name} the nodes, window {window}",
            f"{100 * (at(window, factor, LOAD)[0] / at(window, 1.0, LOAD)[0] - 1):+.3g} %",
        )
        for window in ("a", "b")
        for name, factor in (("half", 0.5), ("double", 2.0))
    ]
    for window in ("b", "c"):
        parts = np.array(at(window, 1.0, LOAD)) / whole - 1
        changes.append(
            (
                f"window {window} for a, {parts.size} places",
                f"{100 * parts.mean():+.2g} % on average, {100 * parts.min():+.2g} to {100 * parts.max():+.2g} %",
            )
        )
    line = [one for one in leaks if one.window == "a" and one.resolution == 1.0]
    changes.append(("slope d ln Q/d ln W, window a, half to double the load", f"{sensitivity(line, 1):.2f}"))
    return changes


def _row(name: str, one: Washer) -> dict[str, Any]:
    pairs = zip(one.lift(), one.lift(boxed=True), strict=True)
    lifts = [tuple(with_error(*one) for one in pair) for pair in pairs]
    return {"name": name, "lifts": lifts, "share": figures.point_at(one, 1, data.SHOWN[0]).contact_share}


def numbers(paper: PaperE) -> dict[str, Any]:
    """Return the numbers of the page; speeds are in revolutions per minute."""

    def lifts(one: Washer, *, boxed: bool = False) -> list[dict[str, float]]:
        return [
            {"load": load, "speed": float(speed), "uncertainty": float(uncertainty)}
            for load, (speed, uncertainty) in zip(LOADS, one.lift(boxed=boxed), strict=True)
        ]

    return {
        "washers": {
            name: {
                "homogenized": lifts(one),
                "patir_cheng": lifts(one, boxed=True),
                "films_apart": one.apart(),
                "table_points": one.wall.points,
                "warnings": one.wall.warnings,
            }
            for name, one in paper.washers.items()
        },
        "lays": {name: lifts(one) for name, one in paper.lays.items()},
        "windows": paper.windows,
        "windows_in_a_row": [{"windows": count, "direct_over_homogenized": more + 1} for count, more in paper.rows],
        "provenance": circumstances(),
    }


if __name__ == "__main__":
    run_alone(command)
