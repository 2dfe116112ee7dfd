"""Report on rough gaps: Stokes and Navier–Stokes flow against Reynolds' equation, and where that equation is enough.

python -m scripts.studies.rough_gaps --out OUT. Measured surfaces with --surfaces DIR (or ROUGHFILM_SURFACES). Results
are kept in OUT/found: the same command continues an interrupted run.
"""

import csv
import io
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from roughfilm.batch.executors import local
from roughfilm.contact.foundation.files import replacing
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.studies.table import table_beginning
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.rough_gaps import figures, inertia, range_of_validity, surfaces, waves
from scripts.studies.rough_gaps import map as cheapest
from scripts.studies.rough_gaps.claims import cards, judge, words
from scripts.studies.rough_gaps.scenes import MILLED, milled_window
from scripts.studies.rough_gaps.study import RoughGapStudy
from scripts.studies.runs import FOUND, ModelRun, Place, answers
from scripts.studies.study import Out, Surfaces, counted, publish


@dataclass(frozen=True, kw_only=True)
class Plan:
    """The gaps, surfaces and flows that are solved; tests use fewer."""

    amplitudes: Sequence[float] = waves.AMPLITUDES
    lengths: Sequence[float] = waves.LENGTHS
    drawn: Sequence[float] = waves.DRAWN
    roughnesses: Sequence[float] = surfaces.ROUGHNESSES
    wavelengths: Sequence[float] = surfaces.WAVELENGTHS
    shapes: Sequence[tuple[float, float]] = inertia.WAVES
    reynolds: Sequence[float] = inertia.REYNOLDS
    slopes: Sequence[float] = cheapest.SLOPES
    map_lengths: Sequence[float] = cheapest.LENGTHS
    points: int = range_of_validity.POINTS
    thicknesses: Sequence[float] = range_of_validity.THICKNESSES
    made: Path = field(default=range_of_validity.MADE)
    mesh: bool = True
    place: Place = local


@in_one_line
def command(out: Out, surfaces: Surfaces = None, as_json: AsJson = False) -> None:
    """Solve rough gaps by every model and report where Reynolds' equation is good enough."""
    write(out, compute(out / FOUND, surfaces), as_json=as_json)


def compute(folder: Path, instruments: Path | None = None, plan: Plan | None = None) -> RoughGapStudy:
    """Compute all data of the page; ``folder`` stores the results, ``instruments`` holds measured surfaces."""
    plan = Plan() if plan is None else plan
    make_directory(folder)
    cases = surfaces.cases(milled_window(instruments, folder / "window.h5"), plan.roughnesses, plan.wavelengths)
    asked: list[ModelRun] = []
    if plan.mesh:
        asked += waves.asked(plan.amplitudes, plan.lengths)
        asked += surfaces.asked(cases)
        asked += inertia.asked(plan.shapes, plan.reynolds)
    found, failed = answers(asked, folder, plan.place)
    made = range_of_validity.made_surfaces(plan.made, plan.points)
    measured = range_of_validity.measured_surfaces(instruments, plan.points)
    with counted(len(made) + len(measured) + 3) as advance:
        advance("exact flow over waves")
        all_waves = waves.waves(found, folder, plan.amplitudes, plan.lengths, plan.drawn)
        advance("random surfaces")
        compared = surfaces.surfaces(cases, found)
        reach = [
            one
            for group, is_measured in ((measured, True), (made, False))
            for one in range_of_validity.reach(
                group, measured=is_measured, folder=folder, thicknesses=plan.thicknesses, advance=advance
            )
        ]
        advance("the map")
        return RoughGapStudy(
            waves=all_waves,
            surfaces=compared,
            inertia=inertia.inertia(found, plan.shapes, plan.reynolds),
            reach=tuple(reach),
            map=cheapest.errors(folder, plan.slopes, plan.map_lengths),
            runs=len(found),
            cpu_s=sum(one.numerics.cpu_s for one in found.values()),
            failed=failed,
        )


def write(out: Path, study: RoughGapStudy, *, as_json: bool = False) -> None:
    """Write the page, its figures, and the numbers as JSON and CSV."""
    make_directory(out)
    for name, rows in tables(study).items():
        text = as_csv(rows)
        with replacing(out / f"{name}.csv", table_beginning(text.split(",")[0])) as scratch:
            scratch.write_text(text, encoding="utf-8")
    findings = words(study)
    publish(
        Path(__file__).parent,
        out,
        {name: draw(study) for name, draw in figures.drawings(study).items()},
        {**vars(study), "findings": findings, "provenance": circumstances()},
        claims=judge(study),
        as_json=as_json,
        results=study,
        words=findings,
        cards=cards(study),
        marked=[across(wave) for wave in study.waves.resolved],
        milled=MILLED,
        names=dict.fromkeys(one.name for one in study.inertia.flows),
    )


def across(wave: waves.Wave) -> dict[str, Any]:
    """Return a line of the table of waves, for the flow across the crests."""
    theory, mesh = wave.found.theory["A11"], wave.found.resolved.get("A11")
    return {
        "amplitude": wave.amplitude,
        "length": wave.length,
        "slope": wave.slope,
        "exact": wave.exact.get("A11"),
        "mesh": None if mesh is None else mesh.value,
        "mesh_bar": None if mesh is None else mesh.uncertainty,
        **asdict(theory),
        "bare": 1 - waves.bare_coefficient(wave.amplitude) * wave.slope**2,
    }


def tables(study: RoughGapStudy) -> dict[str, list[dict[str, Any]]]:
    """Return the numbers as rows, by the name of their file."""
    return {
        "waves": [
            {"amplitude": wave.amplitude, "length": wave.length, "slope": wave.slope} | _row(wave.found, wave.exact)
            for wave in (*study.waves.resolved, *study.waves.drawn)
        ],
        "surfaces": [
            {
                "group": one.group,
                "name": one.name,
                "slope": one.slope,
                "roughness": one.roughness,
                "wavelength": one.wavelength,
            }
            | _row(one, {})
            for one in study.surfaces
        ],
        "inertia": [asdict(one) for one in study.inertia.flows],
        "reach": [
            {"surface": one.name, "measured": one.measured, "rms_height": one.rms_height, "slope": one.slope}
            | asdict(gap)
            for one in study.reach
            for gap in one.found
        ],
        "map": [asdict(one) for one in study.map],
    }


def _row(one: Any, exact: dict[str, float]) -> dict[str, Any]:
    row: dict[str, Any] = {}
    for name, theory in one.theory.items():
        row |= {f"{name}_{key}": value for key, value in asdict(theory).items()}
        row[f"{name}_exact"] = exact.get(name)
        stokes = one.resolved.get(name)
        row[f"{name}_stokes"] = None if stokes is None else stokes.value
        row[f"{name}_stokes_bar"] = None if stokes is None else stokes.uncertainty
    return row


def as_csv(rows: Sequence[dict[str, Any]]) -> str:
    """Return CSV text with a header and a line for each row; fields without a number are empty."""
    text = io.StringIO()
    if rows:
        writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return text.getvalue()


if __name__ == "__main__":
    run_alone(command)
