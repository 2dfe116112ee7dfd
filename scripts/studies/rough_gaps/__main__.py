"""The report on rough gaps: Stokes and Navier–Stokes flow beside Reynolds', and where nobody needs the mesh.

python -m scripts.studies.rough_gaps --out OUT. Measured surfaces with --surfaces DIR (or ROUGHFILM_SURFACES). What
was solved is kept in OUT/found: the same command goes on where it was stopped.
"""

import csv
import io
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Annotated, Any

import typer

from roughfilm.batch.executors import local
from roughfilm.contact.foundation.files import replacing
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from scripts.studies.study import Claim, Surfaces, tell, write_numbers
from scripts.studies.rough_gaps import inertia as rough_gaps_inertia
from scripts.studies.rough_gaps import map as rough_gaps_map
from scripts.studies.rough_gaps import range_of_validity as rough_gaps_reach
from scripts.studies.rough_gaps import surfaces as rough_gaps_surfaces
from scripts.studies.rough_gaps import waves as rough_gaps_waves
from scripts.studies.rough_gaps.claims import cards, judge, words
from scripts.studies.rough_gaps.data import plain
from scripts.studies.rough_gaps.runs import FOUND, Asked, Place, answers
from scripts.studies.rough_gaps.scenes import MILLED, milled_window
from scripts.studies.rough_gaps.study import Study


@dataclass(frozen=True, kw_only=True)
class Plan:
    """How much is looked at; less of it in a test."""

    amplitudes: Sequence[float] = rough_gaps_waves.AMPLITUDES
    lengths: Sequence[float] = rough_gaps_waves.LENGTHS
    drawn: Sequence[float] = rough_gaps_waves.DRAWN
    roughnesses: Sequence[float] = rough_gaps_surfaces.ROUGHNESSES
    wavelengths: Sequence[float] = rough_gaps_surfaces.WAVELENGTHS
    shapes: Sequence[tuple[float, float]] = rough_gaps_inertia.WAVES
    reynolds: Sequence[float] = rough_gaps_inertia.REYNOLDS
    slopes: Sequence[float] = rough_gaps_map.SLOPES
    map_lengths: Sequence[float] = rough_gaps_map.LENGTHS
    points: int = rough_gaps_reach.POINTS
    thicknesses: Sequence[float] = rough_gaps_reach.THICKNESSES
    made: Path = field(default=rough_gaps_reach.MADE)
    mesh: bool = True
    place: Place = local


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, its figures, the numbers, and all that is solved go here.")],
    surfaces: Surfaces = None,
    as_json: AsJson = False,
) -> None:
    """Solve rough gaps by every rung and write rough_gaps.html: where Reynolds' equation is good enough."""
    write(out, compute(out / FOUND, surfaces), as_json=as_json)


def compute(folder: Path, surfaces: Path | None = None, plan: Plan | None = None) -> Study:
    """Everything that the page shows, kept in a folder."""
    plan = Plan() if plan is None else plan
    make_directory(folder)
    window = milled_window(surfaces, folder / "window.h5")
    cases = rough_gaps_surfaces.cases(window, plan.roughnesses, plan.wavelengths)
    asked: list[Asked] = []
    if plan.mesh:
        asked += rough_gaps_waves.asked(plan.amplitudes, plan.lengths)
        asked += rough_gaps_surfaces.asked(cases)
        asked += rough_gaps_inertia.asked(plan.shapes, plan.reynolds)
    found, failed = answers(asked, folder, plan.place)
    made = rough_gaps_reach.made_surfaces(plan.made, plan.points)
    measured = rough_gaps_reach.measured_surfaces(surfaces, plan.points)
    with progress_bar(len(made) + len(measured) + 3) as bar:
        advance = _counted(bar)
        advance("exact flow over waves")
        waves = rough_gaps_waves.waves(found, folder, plan.amplitudes, plan.lengths, plan.drawn)
        advance("random surfaces")
        compared = rough_gaps_surfaces.surfaces(cases, found)
        reach = [
            one
            for group, is_measured in ((measured, True), (made, False))
            for one in rough_gaps_reach.reach(
                group, measured=is_measured, folder=folder, thicknesses=plan.thicknesses, advance=advance
            )
        ]
        advance("the map")
        return Study(
            waves=waves,
            surfaces=compared,
            inertia=rough_gaps_inertia.inertia(found, plan.shapes, plan.reynolds),
            reach=tuple(reach),
            map=rough_gaps_map.errors(folder, plan.slopes, plan.map_lengths),
            runs=len(found),
            cpu_s=sum(one.numerics.cpu_s for one in found.values()),
            failed=failed,
        )


def _counted(bar: Callable[[float, str], None]) -> Callable[[str], None]:
    done = -1

    def advance(words: str) -> None:
        nonlocal done
        done += 1
        bar(done, words)

    return advance


def write(out: Path, study: Study, *, as_json: bool = False) -> None:
    """The page, its figures as files, and the numbers as JSON and CSV."""
    from roughfilm.figures.base import svg
    from scripts.studies.rough_gaps import figures as rough_gaps_figures  # matplotlib is slow to import

    make_directory(out)
    claims = judge(study)
    plots = {name: svg(draw(study)) for name, draw in rough_gaps_figures.drawings(study).items()}
    write_figures(plots, out)
    told = numbers(study, claims)
    write_numbers(told, out / "rough_gaps.json")
    for name, rows in tables(study).items():
        with replacing(out / f"{name}.csv") as scratch:
            scratch.write_text(as_csv(rows), encoding="utf-8")
    render(
        Path(__file__).parent / "page.html.j2",
        out / "rough_gaps.html",
        plots=plots,
        claims=claims,
        study=study,
        words=words(study),
        cards=cards(study),
        marked=[across(wave) for wave in study.waves.resolved],
        milled=MILLED,
        names=dict.fromkeys(one.name for one in study.inertia.flows),
    )
    tell(claims, told, out / "rough_gaps.html", as_json=as_json)


def numbers(study: Study, claims: Sequence[Claim]) -> dict[str, Any]:
    """What the page tells, as entries that JSON can hold."""
    entries = plain({**asdict(study), "findings": words(study)})
    assert isinstance(entries, dict)
    return {"claims": [asdict(claim) for claim in claims], **entries, "provenance": circumstances()}


def across(wave: rough_gaps_waves.Wave) -> dict[str, Any]:
    """A line of the table of waves, in the flow across the crests."""
    theory, mesh = wave.found.theory["A11"], wave.found.resolved.get("A11")
    return {
        "amplitude": wave.amplitude,
        "length": wave.length,
        "slope": wave.slope,
        "exact": wave.exact.get("A11"),
        "mesh": None if mesh is None else mesh.value,
        "mesh_bar": None if mesh is None else mesh.uncertainty,
        "corrected": theory.corrected,
        "bar": theory.bar,
        "bound": theory.bound,
        "perturbed": theory.perturbed,
        "bare": 1 - rough_gaps_waves.bare_coefficient(wave.amplitude) * wave.slope**2,
    }


def tables(study: Study) -> dict[str, list[dict[str, Any]]]:
    """The numbers again as rows, by the name of their file."""
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
    """A header and a line for each row; nothing where there is no number."""
    text = io.StringIO()
    if rows:
        writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return text.getvalue()


if __name__ == "__main__":
    run_alone(command)
