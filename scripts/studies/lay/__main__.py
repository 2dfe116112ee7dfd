"""Compare Patir and Cheng's flow factors with the homogenized ones, and judge bad joints and an offset at contact.

python -m scripts.studies.lay --out OUT. Made surfaces, and measured ones with --surfaces DIR (or ROUGHFILM_SURFACES).
Source: F. Sahlin, Luleå 2008, Paper E: Fig. E.22, E.4.1 and page 172.
"""

from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.lay import data, figures, joint, measured, offset
from scripts.studies.lay.claims import Lay, judge
from scripts.studies.lay.measured import OBLIQUE, SHOWN
from scripts.studies.study import Out, Surfaces, counted, publish

DIRECTIONS = {(False, False): "", (True, False): "x", (False, True): "y", (True, True): "x, y"}
"""Sealed directions in words, by whether a gap is sealed along x and y."""


@in_one_line
def command(out: Out, surfaces: Surfaces = None, as_json: AsJson = False) -> None:
    """Turn grooves against the flow, cut them at joints, add an offset at contact, and judge the source's claims."""
    make_directory(out)
    lay = compute(surfaces)
    results = numbers(lay)
    publish(
        Path(__file__).parent,
        out,
        {name: draw(lay) for name, draw in figures.drawings(lay).items()},
        results,
        claims=judge(lay),
        as_json=as_json,
        measured=lay.measured.get(OBLIQUE),
        shown=[row for row in results["measured"] if row["name"] == OBLIQUE and row["separation"] in SHOWN],
        directions=DIRECTIONS,
        offset=offset.OFFSET,
    )


def compute(surfaces: Path | None = None, *, points: int = data.POINTS, coarser: int = 1) -> Lay:
    """Compute everything the page shows; ``coarser`` takes only every n-th seed, turn, shift and separation."""
    prepared = measured.prepared_surfaces(surfaces, points)
    with counted(data.PARTS + 1 + joint.PARTS + len(offset.MADE) + len(prepared)) as advance:
        turned = data.turn_all(advance, points=points, coarser=coarser)
        advance("measured surfaces")
        return Lay(
            turned=turned,
            measured={name: measured.over_separations(name, one) for name, one in prepared.items()},
            joints=joint.join_all(prepared, advance, nodes=3 * points // 4, coarser=coarser),
            offsets=offset.offset_all(prepared, advance, points=points, coarser=coarser),
        )


def numbers(lay: Lay) -> dict[str, Any]:
    """Return the numbers of the page; factors are relative to a smooth film of the mean thickness."""
    return {
        "turned": [
            {"texture": texture, "thickness": thickness, "degrees": np.degrees(data.angle(turn))} | _factors(one)
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
            "windows": lay.joints.windows,
            "measured": [{"name": name} | asdict(one) for name, row in lay.joints.measured.items() for one in row],
        },
        "offsets": [
            {"name": name} | asdict(one) | {"added": one.added, "slit": one.slit}
            for name, row in lay.offsets.items()
            for one in row
        ],
        "provenance": circumstances(),
    }


def _factors(one: data.FactorPair) -> dict[str, Any]:
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


if __name__ == "__main__":
    run_alone(command)
