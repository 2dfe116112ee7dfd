"""roughfilm factors: flow factors of a rough surface, at one mean gap or as a table over the mean gap."""

import hashlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import HEADER_BYTES, marked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import Quantity, to_si
from roughfilm.contact.foundation.writing.kinds import PAGE
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.store import is_series, load_contact, load_series
from roughfilm.contact.read import HeightMap, parse_spacing, periodicity_warnings, read_height_map
from roughfilm.contact.surfaces.plausibility import implausible
from roughfilm.contact.surfaces.store import load_surface
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MIN_SPACING, Surface
from roughfilm.contact.windows.average import ScatteredQuantity
from roughfilm.rom.bearing.mixed.tabulate import gap_of, tabulate_pressed
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.factors import NAMES
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.kept import kept_table, table_inputs
from roughfilm.rom.homogenization.table.resume import Work, resumed_table
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.store import MARK
from roughfilm.rom.homogenization.table.tabulate import INTERPOLATION_TOLERANCE, tabulate
from roughfilm.rom.homogenization.table.windows import factors_at, point_quantities, tabulate_windows
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import code
from roughfilm.sampling.cells import read_cells
from roughfilm.terminal.console import (
    NUMERICS,
    OUTPUT,
    AsJson,
    ReportFile,
    Spacing,
    Threads,
    progress_bar,
)
from roughfilm.terminal.output_file import alone, refuse_same, refuse_unwritable
from roughfilm.terminal.results import origin, show_result, table_of, written
from roughfilm.words.average import rounded

EXAMPLES = (
    "roughfilm factors scripts/examples/surfaces/milled.toml --gap 3um",
    "roughfilm factors scripts/examples/surfaces/milled.toml --out table.h5",
)

SOURCES = ("10.1016/j.triboint.2007.02.021", "10.1016/j.triboint.2006.02.069", "Sahlin 2008, Papers C and E")
TABLE_FACTORS = ("A11", "A12", "A22", "B1", "B2")
SCATTERED_FACTORS = ("A11", "A22", "B1")
"""Factors that the table of means over windows shows with their scatter."""

DRAWN_CONTACT = 0.2
"""The flow is drawn at the point of a table whose contact fraction is nearest to this."""

Entries = dict[str, Any]


def command(
    surface: Annotated[
        Path,
        typer.Argument(
            metavar="SURFACE",
            help="A surface (HDF5, TOML, an instrument's file), heights (NPY), contacts, or a set of windows.",
        ),
    ],
    gap: Annotated[
        str | None, typer.Option(metavar="H", help="One mean gap, e.g. 3um (default: all, as a table).")
    ] = None,
    spacing: Spacing = None,
    tolerance: Annotated[
        float | None,
        typer.Option(
            help=f"Relative interpolation error of the table (default {INTERPOLATION_TOLERANCE:g}).",
            rich_help_panel=NUMERICS,
        ),
    ] = None,
    rule: Annotated[FaceRule, typer.Option(help="Course of the gap between two nodes.")] = FaceRule.LINEAR,
    offset: Annotated[
        str | None,
        typer.Option(
            metavar="H", help="Constant added to the gap (only with --gap); the reported mean gap includes it."
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Write the table here (HDF5); points that it holds are not solved again.", rich_help_panel=OUTPUT
        ),
    ] = None,
    report: ReportFile = None,
    threads: Threads = None,
    as_json: AsJson = False,
) -> None:
    """Compute pressure, shear and friction flow factors of a rough surface.

    A file of contacts (roughfilm contact ... --out) makes one table from thick films to crushed asperities. The
    directory of a set of windows (roughfilm windows ... --out) gives the means over the windows and their scatter.
    """
    refuse_same({"SURFACE": surface, "--out": out, "--report": report})
    spent = stopwatch()
    mean_gap, constant = _length("--gap", gap), _length("--offset", offset, least=0.0) or 0.0
    if mean_gap is not None and out is not None:
        raise InputError("--out: holds a table; leave it or --gap out")
    if mean_gap is None and offset is not None:
        raise InputError("--offset: got one for a table, in which contact is closed; give --gap, or leave it out")
    if mean_gap is not None and tolerance is not None:
        raise InputError("--tolerance: belongs to a table; leave it or --gap out")
    accuracy, workers = INTERPOLATION_TOLERANCE if tolerance is None else tolerance, checked_threads(threads)
    refuse_unwritable((out, marked(MARK)), (report, PAGE))
    with alone(out, "table"), progress_bar(1.0) as advance:
        advance(0, f"reading {surface.name}")
        cells = read_cells(surface) if surface.is_dir() else None
        contacts = _read_contacts(surface) if surface.is_file() and is_series(surface) else None
        if contacts is not None and mean_gap is not None:
            raise InputError(f"--gap: {surface} holds contacts, which make a table; leave --gap out")
        if cells is not None and spacing is not None:
            raise InputError(f"--spacing: got {spacing}; the windows of {surface} hold their spacing, leave it out")
        rough = (
            _undeformed(surface, contacts[0])
            if contacts
            else read_height_map(surface if cells is None else cells.paths[0], parse_spacing(spacing), periodic=True)
        )
        windows = [rough.heights] if cells is None else [load_surface(path).heights for path in cells.paths]
        independent = None if cells is None else cells.independent
        if min(rough.heights.shape) < 2:
            raise InputError(
                f"{surface}: is a profile; roughfilm.rom.homogenization.line has its flow factors in closed form"
            )
        settings: Entries = {"rule": rule.value, "offset": constant, "mean_gap": mean_gap, "code": code()}
        table = None
        if mean_gap is not None:
            separations = Separations(heights=rough.heights)
            drawn_gap = separations.gap(separations.at_mean_gap(mean_gap))
            point = factors_at(
                windows,
                rough.spacing,
                mean_gap,
                independent=independent,
                rule=rule,
                offset=constant,
                progress=advance,
            )
            entries = _entries_at(point)
        else:
            options = {"tolerance": accuracy, "rule": rule, "threads": workers, "progress": advance}
            work: Callable[..., FactorTable] = partial(_table_of_surface, surface, rough, options)
            if contacts is not None:
                settings |= {name: contacts[0].settings[name] for name in ("composite_modulus", "hardness")}
                work = partial(_table_of_contacts, surface, *contacts, options)
            heights = rough.heights
            if cells is not None:
                settings |= {"windows": len(windows), "independent": cells.independent}
                heights = np.concatenate([cell - cell.mean() for cell in windows])
                work = partial(_table_of_windows, windows, rough.spacing, cells.independent, options)
            inputs = Inputs(heights=heights, spacing=rough.spacing, settings=settings)
            table, known = resumed_table(out, inputs, partial(_kept, surface, inputs, accuracy, work, advance))
            settings = settings | {"tolerance": accuracy}
            entries = _table_entries(table)
            entries["numerics"]["separations_found"] = known
        entries["numerics"] |= {"points": rough.heights.size, **spent()}
        warnings = [*rough.warnings, *_table_warnings(table, accuracy)]
        if cells is not None:
            entries["windows"] = cells.entries()
            warnings += cells.warnings
        entries["provenance"] = origin(SOURCES, warnings, surface=dict(rough.source), settings=settings)
        if report is not None:
            from roughfilm.pages.factors import write_page  # matplotlib is slow to import

            advance(1.0, "drawing the page")
            if table is not None:
                drawn_gap = _drawn_gap(table, rough, settings)
            factors = flow_factors(drawn_gap, rough.spacing, rule=rule, offset=constant)
            write_page(surface.name, entries, _points_of(entries), rough, report, drawn_gap, factors, table)

    def shown() -> Iterator[Table | str]:
        yield _table(surface.name, _points_of(entries))

    summary = written(_in_words(_points_of(entries)), out, report)
    show_result(entries, shown(), as_json=as_json, reused="separations", summary=summary)


def _length(option: str, text: str | None, least: float = MIN_SPACING) -> float | None:
    if text is None:
        return None
    try:
        length = to_si(text.strip(), "m")
    except ValueError as error:
        raise InputError(f"{option} {text}: {error}") from None
    if not least <= length <= MAX_LENGTH:
        raise InputError(f"{option} {text}: give a length of {least:g} to {MAX_LENGTH:g} m")
    return length


def _kept(
    surface: Path,
    inputs: Inputs,
    tolerance: float,
    work: Work,
    progress: Progress,
    known: Sequence[Point],
    keep: Callable[[Point], None],
) -> FactorTable:
    """The table from the cache, or made and kept there; a file of contacts is known by the bytes of its header."""
    pressed = "composite_modulus" in inputs.settings
    own = {name: value for name, value in inputs.settings.items() if name != "code"} | {"tolerance": tolerance}
    if pressed:
        with surface.open("rb") as file:
            own["contacts"] = hashlib.sha256(file.read(HEADER_BYTES)).hexdigest()
    module = (
        "rom.bearing.mixed.tabulate"
        if pressed
        else f"rom.homogenization.table.{'windows' if 'windows' in own else 'tabulate'}"
    )
    return kept_table(
        table_inputs(inputs.heights, inputs.spacing, module, **own),
        work,
        about={"surface": surface.name, "kind": "flow factors and contact" if pressed else "flow factors"},
        progress=progress,
        foreign=known,
        keep=keep,
    )


def _table_of_surface(
    surface: Path,
    rough: HeightMap,
    options: Mapping[str, Any],
    known: Sequence[Point],
    keep: Callable[[Point], None],
) -> FactorTable:
    """The table of an undeformed surface."""
    try:
        return tabulate(rough.heights, rough.spacing, known=known, keep=keep, **options)
    except InputError as error:
        raise InputError(str(error).replace("heights:", f"{surface}:")) from None


def _table_of_windows(
    windows: Sequence[Array],
    spacing: tuple[float, float],
    independent: float,
    options: Mapping[str, Any],
    known: Sequence[Point],
    keep: Callable[[Point], None],
) -> FactorTable:
    """The table of the means over the windows of a set."""
    return tabulate_windows(windows, spacing, independent=independent, known=known, keep=keep, **options)


def _table_of_contacts(
    file: Path,
    pressed: Inputs,
    loads: Sequence[float],
    options: Mapping[str, Any],
    known: Sequence[Point],
    keep: Callable[[Point], None],
) -> FactorTable:
    """The table of a surface under a series of loads, from the contacts in a file."""
    return tabulate_pressed(
        pressed.heights,
        pressed.spacing,
        pressed.settings["composite_modulus"],
        hardness=pressed.settings["hardness"] or math.inf,
        loads=loads,
        known=known,
        keep=keep,
        stored=lambda load: load_contact(file, load) if load in loads else None,
        **options,
    ).factors


def _drawn_gap(table: FactorTable, rough: HeightMap, settings: Mapping[str, Any]) -> Array:
    """The gap, m, at the point of a table whose flow is drawn; that of the first window of several."""
    drawn = min(table.points, key=lambda point: (any(point.factors.sealed), abs(point.contact - DRAWN_CONTACT)))
    if drawn.load == 0:
        body = Separations(heights=rough.heights)
        return body.gap(drawn.separation if drawn.scatter is None else body.at_mean_gap(drawn.mean_gap))
    hardness = settings["hardness"] or math.inf
    return gap_of(drawn, Press(rough.heights, rough.spacing, settings["composite_modulus"], hardness=hardness))


def _undeformed(path: Path, pressed: Inputs) -> HeightMap:
    """The undeformed surface of a file of contacts."""
    source = {"file": path.name, "settings": dict(pressed.settings)}
    surface = Surface(heights=pressed.heights, spacing=pressed.spacing)
    warnings = (*implausible(surface, path), *periodicity_warnings(path, surface, measured=False))
    return HeightMap(heights=pressed.heights, spacing=pressed.spacing, source=source, warnings=warnings)


def _read_contacts(path: Path) -> tuple[Inputs, tuple[float, ...]]:
    """The inputs and loads of a file of contacts; InputError where it cannot make a table."""
    pressed, loads = load_series(path)
    if len(loads) < 2:
        content = f"holds contacts with their gaps at {len(loads)} loads, by the model {pressed.settings['model']}"
        raise InputError(f"{path}: {content}; make one of two or more: roughfilm contact S.h5 --loads ... --out C.h5")
    if pressed.settings["boundary"] != "periodic":
        raise InputError(f"{path}: has a surface that stands alone; a periodic film needs --boundary periodic")
    return pressed, loads


def _relative(point: Point) -> dict[str, dict[str, Any]]:
    """Each factor over that of a smooth film of the mean gap, with its uncertainty; None where that is unknown.

    A mean over windows has its scatter and the interval for one window too.
    """
    return {name: _entries_of(one) for name, one in point_quantities(point).items()}


def _entries_of(one: Quantity) -> dict[str, Any]:
    entries: dict[str, Any] = {"value": one.value, "uncertainty": one.uncertainty}
    if isinstance(one, ScatteredQuantity):
        ends = one.window_interval
        entries |= {"scatter": one.scatter, "window_interval": None if ends is None else list(ends)}
    return entries


def _entries_at(point: Point) -> Entries:
    """The object of ``--json`` for one mean gap, without provenance."""
    factors = point.factors
    sealed = dict(zip(("sealed_x", "sealed_y"), factors.sealed, strict=True))
    values = {**sealed, "mean_gap": factors.mean_gap, "separation": point.separation, "contact": point.contact}
    return {
        "quantities": {
            **{name: {**entry, "unit": "1"} for name, entry in _relative(point).items()},
            **{
                name: {"value": value, "unit": "m" if name in ("mean_gap", "separation") else "1"}
                for name, value in values.items()
            },
        },
        **sealed,
        "numerics": {name: getattr(point, name) for name in ("unsolved", "residual", "iterations")},
    }


def _table_entries(table: FactorTable) -> Entries:
    """The object of ``--json`` for a table, without provenance."""
    numbers = ("mean_gap", "separation", "contact", "load", "area_fraction", "plastic_fraction")
    return {
        "points": [
            {
                **{name: getattr(point, name) for name in numbers},
                **dict(zip(("sealed_x", "sealed_y"), point.factors.sealed, strict=True)),
                **_relative(point),
            }
            for point in table.points
        ],
        "units": {"mean_gap": "m", "separation": "m", "contact": "1", "load": "Pa", **dict.fromkeys(NAMES, "1")},
        "quantities": {
            "narrowest": {"value": table.narrowest, "unit": "m"},
            "widest": {"value": table.widest, "unit": "m"},
            "interpolation_error": {"value": table.interpolation_error, "unit": "1"},
        },
        "numerics": {
            "unsolved": max(point.unsolved for point in table.points),
            "residual": max(point.residual for point in table.points),
            "iterations": sum(point.iterations for point in table.points),
            "separations": len(table.points),
        },
    }


def _table_warnings(table: FactorTable | None, tolerance: float) -> list[str]:
    if table is None or table.interpolation_error <= tolerance:
        return []
    error = f"the interpolation error of the table is {table.interpolation_error:.2g}, above {tolerance:g}"
    return [f"{error}: factors jump, or 400 points are too few; check the surface for spikes and plateaus"]


def _points_of(entries: Mapping[str, Any]) -> list[Entries]:
    """The points of a table, or the one point of a mean gap, as entries of ``--json``."""
    quantities = entries["quantities"].items()
    return entries.get("points") or [
        {name: entry if "uncertainty" in entry else entry["value"] for name, entry in quantities}
    ]


def _in_words(points: Sequence[Entries]) -> str:
    """The flow factor along x of one gap, or the range of gaps of a table, as a sentence."""
    if len(points) == 1:
        factor = points[0]["A11"]
        number = _rounded(factor["value"], factor["uncertainty"])
        if "scatter" in factor:
            number += f" ± {rounded(factor['scatter'], factor['value'])} (windows)"
        return (
            f"a mean gap of {1e6 * points[0]['mean_gap']:.4g} µm carries {number} times the flow of a smooth one in x"
        )
    gaps = sorted(1e6 * point["mean_gap"] for point in points)
    return f"flow factors at {len(points)} mean gaps of {gaps[0]:.4g} to {gaps[-1]:.4g} µm"


def _table(name: str, points: Sequence[Entries]) -> Table:
    """The points as a table of factors over those of a smooth film of the same mean gap."""
    pressed = any(point.get("load") for point in points)
    if any("scatter" in point["A11"] for point in points):
        return _table_over_windows(name, points)
    heads = (*(["load, MPa"] if pressed else []), "ĥ, µm", "contact, %", *TABLE_FACTORS, "sealed")
    rows = [
        (
            *([f"{point['load'] / 1e6:.4g}"] if pressed else []),
            f"{1e6 * point['mean_gap']:.4g}",
            f"{100 * point['contact']:.3g}",
            *(_rounded(point[name]["value"], point[name]["uncertainty"]) for name in TABLE_FACTORS),
            " ".join(axis for axis in "xy" if point[f"sealed_{axis}"]),
        )
        for point in points
    ]
    return table_of(heads, rows, title=name)


def _table_over_windows(name: str, points: Sequence[Entries]) -> Table:
    """The means over windows, each rounded to its numerical uncertainty, with their scatter beside them."""
    heads = [part for factor in SCATTERED_FACTORS for part in (factor, "±, windows")]
    rows = [
        (
            f"{1e6 * point['mean_gap']:.4g}",
            f"{100 * point['contact']:.3g}",
            *(
                text
                for factor in SCATTERED_FACTORS
                for text in (
                    _rounded(point[factor]["value"], point[factor]["uncertainty"]),
                    rounded(point[factor]["scatter"], point[factor]["value"]),
                )
            ),
            " ".join(axis for axis in "xy" if point[f"sealed_{axis}"]),
        )
        for point in points
    ]
    return table_of(("ĥ, µm", "contact, %", *heads, "sealed"), rows, title=f"{name}: means over windows")


def _rounded(value: float, uncertainty: float | None) -> str:
    """A value to the digits that its uncertainty leaves."""
    if uncertainty is None:
        return f"{value:.3g} ± ?"
    digits = max(0, min(5, math.ceil(-math.log10(uncertainty)))) if uncertainty else 5
    return f"{round(value, digits) + 0.0:.{digits}f}"
