"""Verify the OpenFOAM models of a cell in plan: grid convergence, steep walls, grooves as limits, another mesh.

python -m scripts.studies.dimples.verification --out OUT CHECK... with CHECK from ``CHECKS``. Each run is kept in OUT
and used again by the next call. ``docs/theory/openfoam.md`` has the tables.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.pocket.plan.mesh import vertices
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.studies.convergence import converge
from roughfilm.terminal.console import in_one_line, output, run_alone
from scripts.studies.dimples.snapped import snapped
from scripts.studies.study import Out, kept

SHOWN = ("load_plus", "load_from_corner_plus", "friction_plus", "pressure_max_plus", "pressure_min_plus")
"""Quantities of a row."""

Row = Mapping[str, Any]
Solved = Callable[..., Row]
"""Function solved(words, scene, resolution, lean=1.0) that solves a scene and returns its row."""

CAP = {"shape": "spherical", "width": "0.3 mm", "depth": "7.5 um"}
GROOVE = {"shape": "groove", "width": "0.2 mm", "depth": "60 um"}

STEEP = {
    0.5: {"shape": "spherical", "width": "0.15 mm", "depth": "17.7 um"},
    1.0: {"shape": "spherical", "width": "0.15 mm", "depth": "31.1 um"},
}
"""Caps by the slope of their rim."""

RAMP = "0.03 mm"
MARGIN = 0.3
"""Land across between long boxes, mm."""


def cell(dimple: Row, *, length: float = 1.0, breadth: float = 1.0, reynolds_number: float = 160.0) -> Pocket:
    """The scene of a cell with one dimple and a film of 30 µm; lengths in mm."""
    geometry = {"length": f"{length} mm", "breadth": f"{breadth} mm", "film": "30 um", "dimples": [dict(dimple)]}
    return scene(geometry, reynolds_number)


def scene(geometry: Row, reynolds_number: float) -> Pocket:
    """The scene of a geometry with water-thin oil."""
    found = read_scene(
        {
            "name": "verification",
            "kind": "pocket",
            "geometry": dict(geometry),
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
            "motion": {"reynolds_number": reynolds_number},
        }
    )
    assert isinstance(found, Pocket)
    return found


def solve(words: str, scene: Pocket, resolution: int, lean: float = 1.0) -> Row:
    """The row of a scene by ``navier_stokes``; ``lean`` 0 is a mesh of vertical columns."""
    before, vertices.LEAN = vertices.LEAN, lean
    try:
        result = find("pocket", "navier_stokes").solve(scene, Request(resolution=resolution))
    finally:
        vertices.LEAN = before
    numerics = result.numerics
    return {
        "case": words,
        "columns": resolution,
        **{name: result.quantities[name].value for name in SHOWN if name in result.quantities},
        "imbalance": numerics.runs[-1].imbalance,
        "iterations": numerics.iterations,
        "cpu_s": numerics.cpu_s,
    }


def limits(words: str, rows: list[Row]) -> Row:
    """The values that the last three rows of grids extrapolate to, and their observed orders."""
    grids = [row["columns"] for row in rows]
    studies = {name: converge(grids, [row[name] for row in rows], formal_order=2) for name in SHOWN}
    found = {name: study.value for name, study in studies.items()}
    orders = ", ".join(
        f"{name.removesuffix('_plus')} {study.order_text or study.kind} ± {study.uncertainty:.2g}"
        for name, study in studies.items()
    )
    return {"case": f"{words}, limit", **found, "orders": orders}


def grids(solved: Solved) -> Iterator[Row]:
    """A shallow cap on grids of 20 to 120 columns."""
    rows = []
    for columns in (20, 40, 80, 120):
        rows.append(solved("cap", cell(CAP), columns))
        yield rows[-1]
    yield limits("cap", rows)


def steep(solved: Solved) -> Iterator[Row]:
    """Steep caps and a steep groove, on columns that meet the walls at right angles and on vertical ones.

    The groove's load by finite elements is 0.2046 (:doc:`pockets`).
    """
    scenes = {
        f"cap of slope {slope}": (cell(cap, length=0.5, breadth=0.5), (24, 48, 72)) for slope, cap in STEEP.items()
    }
    scenes["groove"] = cell(GROOVE, breadth=0.1, reynolds_number=40.0), (60, 120, 180)
    for words, (one, columns) in scenes.items():
        for lean, kind in ((1.0, "leaning"), (0.0, "vertical")):
            rows = []
            for number in columns:
                rows.append(solved(f"{words}, {kind}", one, number, lean))
                yield rows[-1]
            yield limits(f"{words}, {kind}", rows)


def groove(solved: Solved) -> Iterator[Row]:
    """The groove of ``pocket.toml`` in a cell of any breadth, and as a two-dimensional scene (240 columns)."""
    shape = {"width": "0.3 mm", "depth": "7.5 um"}
    rows = []
    for columns in (40, 80, 160):
        rows.append(solved("groove", cell({"shape": "groove", **shape}, breadth=0.1), columns))
        yield rows[-1]
    yield limits("groove", rows)
    flat = scene({"length": "1 mm", "film": "30 um", "profile": "cylindrical", **shape}, 160.0)
    yield solved("two-dimensional", flat, 240)


def long(solved: Solved) -> Iterator[Row]:
    """Boxes that get longer across the sliding between margins of one breadth, and the groove of their section.

    With the load F per area of a cell of breadth B, the part of B F that grows with B is the load of the groove.
    """
    before = None
    for columns in (40, 80):
        for breadth in (0.6, 1.2, 1.8) if columns == 40 else (1.2, 1.8):
            box = {"shape": "box", "width": "0.3 mm", "breadth": f"{breadth - MARGIN:.12g} mm", "depth": "7.5 um"}
            row = solved(f"box, cell {breadth} mm broad", cell({**box, "edge": RAMP}, breadth=breadth), columns)
            yield row
            if before and before[1]["columns"] == columns:
                step = breadth - before[0]
                grown = {
                    name: (breadth * row[name] - before[0] * before[1][name]) / step
                    for name in ("load_plus", "friction_plus")
                }
                yield {"case": f"growth from {before[0]} to {breadth} mm", "columns": columns, **grown}
            before = breadth, row
    points = [[-1.5e-4, 0.0], [-1.2e-4, 7.5e-6], [1.2e-4, 7.5e-6], [1.5e-4, 0.0]]
    section = scene({"length": "1 mm", "film": "30 um", "profile": "points", "points": points}, 160.0)
    for columns in (40, 80, 240):
        yield solved("groove of the section", section, columns)


def snappy(solved: Solved) -> Iterator[Row]:
    """The shallow cap on meshes of snappyHexMesh."""
    rows = []
    for columns in (48, 72, 96):
        rows.append(solved("snappyHexMesh", cell(CAP), columns))
        yield rows[-1]
    yield limits("snappyHexMesh", rows)


CHECKS: Mapping[str, Callable[[Solved], Iterator[Row]]] = {
    "grids": grids,
    "steep": steep,
    "groove": groove,
    "long": long,
    "snappy": snappy,
}
"""The checks by name."""


@in_one_line
def command(out: Out, checks: Annotated[list[str], typer.Argument(help=f"Checks: {', '.join(CHECKS)}.")]) -> None:
    """Run checks and print their tables."""
    for name in checks:
        if name not in CHECKS:
            raise InputError(f"checks: got {name!r}; it must be one of {', '.join(CHECKS)}")

        def solved(words: str, scene: Pocket, resolution: int, lean: float = 1.0, name: str = name) -> Row:
            method = snapped if name == "snappy" else solve
            inputs = {"scene": scene.model_dump_json(), "resolution": resolution, "lean": lean, "check": name}
            place = out / f"{name}_{words.replace(' ', '_').replace(',', '')}_{resolution}.json"
            row: Row = kept(place, inputs, lambda: method(words, scene, resolution, lean))
            return row

        table = Table(title=name)
        for title in ("case", "columns", *SHOWN, "imbalance", "iterations", "CPU s", "orders"):
            table.add_column(title)
        for row in CHECKS[name](solved):
            numbers = [row.get(one) for one in (*SHOWN, "imbalance")]
            table.add_row(
                row["case"],
                str(row.get("columns", "")),
                *("" if value is None else f"{value:.5g}" for value in numbers),
                str(row.get("iterations", "")),
                f"{row['cpu_s']:.3g}" if "cpu_s" in row else "",
                row.get("orders", ""),
            )
        output.print(table)


if __name__ == "__main__":
    run_alone(command)
