"""Where roughness may be averaged: Fig. C.3 of the source, and what averaging errs by over the length of the waves.

python -m scripts.studies.scales --out OUT
"""

import json
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from roughfilm.contact.foundation.files import replacing
from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, output, print_json, progress_bar, run_alone
from scripts.studies.claims import Claim, Surfaces
from scripts.studies.scales.data import (
    DRAWN,
    IN_PLANE,
    NARROW_INLET,
    OF_SURFACE,
    PHASES,
    RATIOS,
    SURFACE,
    Study,
    measured,
    over,
    pad,
    pairs,
    slider,
    solve,
)

GOOD, WAVES = 0.01, 0.02
"""Errors that are good: of load and friction, and of pressure at its worst place, where it waves about the average."""

SOURCES_RATIO = 2.0**-8


def judge(study: Study) -> Claim:
    """Claim 13, by the largest errors over all phases at the ratio that it names."""
    number = study.ratios.index(SOURCES_RATIO)
    pressure, load, friction = (study.worst(name)[number] for name in ("pressure", "load", "friction"))
    good = [ratio for ratio, error in zip(study.ratios, study.worst("pressure"), strict=True) if error <= WAVES]
    verdict = "false" if max(load, friction) > GOOD else "true" if pressure <= WAVES else "partly"
    return Claim(
        number=13,
        text="Homogenized pressure is good already at ε = 2⁻⁸ (0.4 mm of 0.1 m)",
        verdict=verdict,
        evidence=(
            f"at ε = 2⁻⁸, whatever the phase of the waves, pressure is within {100 * pressure:.2g} % of its maximum, "
            f"load within {100 * load:.2g} %, friction within {100 * friction:.2g} %; pressure is within "
            f"{100 * WAVES:.0f} % up to ε = "
            f"{max(good, default=0):.2g}, and the errors fall as ε^{study.rate('pressure'):.2f} (pressure) and "
            f"ε^{study.rate('load'):.2f} (load)"
        ),
    )


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, its figures and the numbers go here.")],
    surfaces: Surfaces = None,
    as_json: AsJson = False,
) -> None:
    """Follow every wave and average them all, over the length of the waves, and write scales.html."""
    from scripts.studies.scales import figures as scales_figures  # matplotlib is slow to import

    make_directory(out)
    with progress_bar(4) as bar, tempfile.TemporaryDirectory(prefix="roughfilm-scales-") as scratch:
        bar(0, "ridges across a slider")
        across = pairs(slider, "ridges across, infinitely wide", RATIOS, PHASES)
        bar(1, "slanting ridges on a pad")
        slanting = pairs(pad, "ridges at 45° on a square pad", IN_PLANE, PHASES[::2])
        bar(2, "a measured surface")
        cell = measured(surfaces, Path(scratch))
        studies = [across, slanting]
        if cell is not None:
            studies.append(
                pairs(lambda ratio, phase: over(cell, ratio, phase), f"measured: {SURFACE}", OF_SURFACE, (0.0,))
            )
        starved = pairs(lambda ratio, phase: slider(ratio, phase, "0 Pa"), "", (SOURCES_RATIO,), (NARROW_INLET,))
        bar(3, "figures")
        averaged = solve(slider(DRAWN[0], 0.0), "homogenized")
        drawn = {ratio: solve(slider(ratio, 0.0), "direct") for ratio in DRAWN}
    plots = {"curves": scales_figures.curves(averaged, drawn), "errors": scales_figures.errors(studies)}
    write_figures(plots, out)
    claim = judge(across)
    told = {
        "claims": [asdict(claim)],
        "studies": [asdict(study) for study in studies],
        "rates": {
            s.title: {name: s.rate(name, min(4, len(s.ratios))) for name in ("load", "friction")} for s in studies
        },
        "starved": asdict(starved.pairs[0]),
        "measured": cell is not None,
        "provenance": circumstances(),
    }
    with replacing(out / "scales.json") as file:
        file.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    render(
        Path(__file__).parent / "page.html.j2",
        out / "scales.html",
        plots=plots,
        claim=claim,
        studies=studies,
        starved=starved.pairs[0],
        surface=SURFACE,
        measured=cell,
    )
    if as_json:
        print_json({**told, "report": str(out / "scales.html")})
        return
    for study in studies:
        shown = Table("ε", "load, worst", "load, mean of phases", "friction, worst", title=study.title)
        for row in zip(study.ratios, study.worst("load"), study.mean("load"), study.worst("friction"), strict=True):
            shown.add_row(f"{row[0]:.3g}", *(f"{100 * value:.2g} %" for value in row[1:]))
        output.print(shown)
    output.print(f"13 {claim.verdict}: {escape(claim.evidence)}")
    if cell is None:
        output.print(f"{SURFACE} is not here: no measured surface")
    output.print(f"page: {escape(str(out / 'scales.html'))}", soft_wrap=True)


if __name__ == "__main__":
    run_alone(command)
