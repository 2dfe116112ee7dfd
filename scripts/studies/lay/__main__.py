"""The lay against the flow: Patir and Cheng's factors beside the homogenized ones, bad joints, and contact let through.

python -m scripts.studies.lay --out OUT. Made surfaces, and measured ones with --surfaces DIR (or ROUGHFILM_SURFACES).
Source: F. Sahlin, Luleå 2008, Paper E: Fig. E.22, E.4.1 and page 172.
"""

import math
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from scripts.studies.study import Claim, Surfaces, tell, write_numbers
from scripts.studies.lay import data as lay_data
from scripts.studies.lay import joint as lay_joint
from scripts.studies.lay import measured as lay_measured
from scripts.studies.lay import offset as lay_offset
from scripts.studies.lay.claims import Lay, judge
from scripts.studies.lay.measured import OBLIQUE, SHOWN, prepared_surfaces

DIRECTIONS = {(False, False): "", (True, False): "x", (False, True): "y", (True, True): "x, y"}
"""In words, by whether a gap is sealed along x and y."""


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, its figures and the numbers go here.")],
    surfaces: Surfaces = None,
    as_json: AsJson = False,
) -> None:
    """Turn grooves against the flow, cut them at joints, let contact through, and judge what the source says of it."""
    from roughfilm.figures.base import svg
    from scripts.studies.lay import figures as lay_figures  # matplotlib is slow to import

    make_directory(out)
    lay = compute(surfaces)
    claims = judge(lay)
    plots = {name: svg(draw(lay)) for name, draw in lay_figures.drawings(lay).items()}
    write_figures(plots, out)
    told = numbers(lay, claims)
    write_numbers(told, out / "lay.json")
    render(
        Path(__file__).parent / "page.html.j2",
        out / "lay.html",
        plots=plots,
        claims=claims,
        measured=lay.measured.get(OBLIQUE),
        shown=[row for row in told["measured"] if row["name"] == OBLIQUE and row["separation"] in SHOWN],
        directions=DIRECTIONS,
        offset=lay_offset.OFFSET,
    )
    tell(claims, told, out / "lay.html", as_json=as_json)


def compute(surfaces: Path | None = None, *, points: int = lay_data.POINTS, coarser: int = 1) -> Lay:
    """Everything that the page shows; ``coarser`` takes every so many seeds, turns, shifts and separations only."""
    prepared = prepared_surfaces(surfaces, points)
    parts = lay_data.PARTS + 1 + lay_joint.PARTS + len(lay_offset.MADE) + len(prepared)
    with progress_bar(parts) as bar:
        advance = _counted(bar)
        turned = lay_data.turn_all(advance, points=points, coarser=coarser)
        advance("measured surfaces")
        measured = {name: lay_measured.over_separations(name, one) for name, one in prepared.items()}
        return Lay(
            turned=turned,
            measured=measured,
            joints=lay_joint.join_all(prepared, advance, nodes=3 * points // 4, coarser=coarser),
            offsets=lay_offset.offset_all(prepared, advance, points=points, coarser=coarser),
        )


def _counted(bar: Callable[[float, str], None]) -> Callable[[str], None]:
    done = -1

    def advance(words: str) -> None:
        nonlocal done
        done += 1
        bar(done, words)

    return advance


def numbers(lay: Lay, claims: list[Claim]) -> dict[str, Any]:
    """What the page tells, as entries that JSON can hold: factors over those of a smooth film as thick as the mean."""
    told = {
        "claims": [asdict(claim) for claim in claims],
        "turned": [
            {"texture": texture, "thickness": thickness, "degrees": np.degrees(lay_data.angle(turn))} | _factors(one)
            for (texture, thickness, turn), one in lay.turned.found.items()
        ],
        "isotropic": [
            {"thickness": thickness} | _factors(one) for thickness, row in lay.turned.isotropic.items() for one in row
        ],
        "boxes": {"length_over_width": lay.turned.boxes[0], "factor": lay.turned.boxes[1]},
        "measured": [
            {"name": name, "lay": one.lay, "separation": separation, "box_of_A": one.boxes[separation]} | _factors(both)
            for name, one in lay.measured.items()
            for separation, both in one.found.items()
        ],
        "joints": {
            "cut": [{"shift": shift} | asdict(one) for shift, row in lay.joints.cut.items() for one in row],
            "windows": [asdict(one) for one in lay.joints.windows],
            "measured": [{"name": name} | asdict(one) for name, row in lay.joints.measured.items() for one in row],
        },
        "offsets": [
            {"name": name} | asdict(one) | {"added": one.added, "slit": one.slit}
            for name, row in lay.offsets.items()
            for one in row
        ],
        "provenance": circumstances(),
    }
    made: dict[str, Any] = _plain(told)
    return made


def _factors(one: lay_data.Compared) -> dict[str, Any]:
    return {
        "contact": one.contact,
        "error": one.error,
        "A": one.cell.pressure,
        "B": one.cell.shear,
        "sealed": one.cell.sealed,
        "patir_cheng": one.box.pressure,
        "patir_cheng_shear": one.box.shear,
        "patir_cheng_sealed": one.box.sealed,
    }


def _plain(value: Any) -> Any:
    """Lists for arrays, and null for what is no number."""
    if isinstance(value, dict):
        return {str(name): _plain(one) for name, one in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


if __name__ == "__main__":
    run_alone(command)
