"""Find where roughness may be averaged: Fig. C.3 of the source, and the error of averaging for waves of any length.

python -m scripts.studies.scales --out OUT. Measured surfaces with --surfaces DIR (or ROUGHFILM_SURFACES).
Source: F. Sahlin, Luleå 2008, Paper C.
"""

from pathlib import Path

from rich.table import Table

from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.scales import figures
from scripts.studies.scales.data import (
    DRAWN,
    IN_PLANE,
    NARROW_INLET,
    OF_SURFACE,
    PHASES,
    RATIOS,
    SURFACE,
    WaveErrors,
    measured,
    over,
    pad,
    pairs,
    slider,
    solve,
)
from scripts.studies.study import Claim, Out, Surfaces, counted, publish, verdict

GOOD_LOAD_ERROR, GOOD_PRESSURE_ERROR = 0.01, 0.02
"""Largest relative errors of good averaging: of load and friction, and of the pressure at its worst place."""

SOURCES_RATIO = 2.0**-8
"""Wavelength over the length of the bearing in claim 13."""


def judge(study: WaveErrors) -> Claim:
    """Judge claim 13 by the largest errors over all phases at the ratio that it names."""
    number = study.ratios.index(SOURCES_RATIO)
    pressure, load, friction = (study.worst(name)[number] for name in ("pressure", "load", "friction"))
    errors = zip(study.ratios, study.worst("pressure"), strict=True)
    good = [ratio for ratio, error in errors if error <= GOOD_PRESSURE_ERROR]
    partly = max(load, friction) <= GOOD_LOAD_ERROR
    return Claim(
        number=13,
        text="Homogenized pressure is good already at ε = 2⁻⁸ (0.4 mm of 0.1 m)",
        verdict=verdict(partly and pressure <= GOOD_PRESSURE_ERROR, partly=partly),
        evidence=(
            f"at ε = 2⁻⁸ and any phase of the waves the error of pressure is at most {100 * pressure:.2g} % of its "
            f"maximum, that of load {100 * load:.2g} %, of friction {100 * friction:.2g} %; that of pressure is at "
            f"most {100 * GOOD_PRESSURE_ERROR:.0f} % up to ε = {max(good, default=0):.2g}; the errors fall as "
            f"ε^{study.rate('pressure'):.2f} (pressure) and ε^{study.rate('load'):.2f} (load)"
        ),
    )


@in_one_line
def command(out: Out, surfaces: Surfaces = None, as_json: AsJson = False) -> None:
    """Solve rough films with every wave resolved and with all averaged, for waves of many lengths."""
    make_directory(out)
    with counted(4) as advance, scratch_directory() as scratch:
        advance("ridges across a slider")
        across = pairs(slider, "ridges across, infinitely wide", RATIOS, PHASES)
        advance("slanting ridges on a pad")
        studies = [across, pairs(pad, "ridges at 45° on a square pad", IN_PLANE, PHASES[::2])]
        advance("a measured surface")
        cell = measured(surfaces, scratch)
        if cell is not None:
            studies.append(
                pairs(lambda ratio, phase: over(cell, ratio, phase), f"measured: {SURFACE}", OF_SURFACE, (0.0,))
            )
        starved = pairs(lambda ratio, phase: slider(ratio, phase, "0 Pa"), "", (SOURCES_RATIO,), (NARROW_INLET,))
        advance("figures")
        averaged = solve(slider(DRAWN[0], 0.0), "homogenized")
        drawn = {ratio: solve(slider(ratio, 0.0), "direct") for ratio in DRAWN}
    rates = {s.title: {name: s.rate(name, min(4, len(s.ratios))) for name in ("load", "friction")} for s in studies}
    absent = [] if cell else [f"{SURFACE} is not here: no measured surface"]
    publish(
        Path(__file__).parent,
        out,
        {"curves": figures.curves(averaged, drawn), "errors": figures.errors(studies)},
        {
            "studies": studies,
            "rates": rates,
            "starved": starved.pairs[0],
            "measured": cell is not None,
            "provenance": circumstances(),
        },
        claims=[judge(across)],
        tables=[*map(table, studies), *absent],
        as_json=as_json,
        studies=studies,
        starved=starved.pairs[0],
        surface=SURFACE,
        measured=cell,
    )


def table(study: WaveErrors) -> Table:
    """Return the errors of one kind of roughness as a printed table."""
    shown = Table("ε", "load, worst", "load, mean of phases", "friction, worst", title=study.title)
    for row in zip(study.ratios, study.worst("load"), study.mean("load"), study.worst("friction"), strict=True):
        shown.add_row(f"{row[0]:.3g}", *(f"{100 * value:.2g} %" for value in row[1:]))
    return shown


if __name__ == "__main__":
    run_alone(command)
