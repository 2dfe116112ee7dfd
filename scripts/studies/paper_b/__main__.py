"""Regenerate Figures B.1 to B.17 of Paper B, compare its numbers with ours, and judge its claims.

python -m scripts.studies.paper_b --out OUT. The page lists what the paper leaves open, and our choices.
Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1294, doi:10.1016/j.triboint.2007.02.021.
"""

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.paper_b import data, figures
from scripts.studies.paper_b.claims import MAXIMA_APART, PrintedDifference, judge, maxima, rows
from scripts.studies.paper_b.data import COARSE, CONSTANT, HALF, ORIGINAL, ROUNDED, PaperB, compute, difference
from scripts.studies.study import Out, counted, publish

FRONTS = {"starved": ORIGINAL, "starved, moduli": HALF}
"""Lubricant by case for the films that begin slightly downstream of the reference."""


@in_one_line
def command(out: Out, as_json: AsJson = False) -> None:
    """Solve the films of Paper B, draw its figures, and judge its claims."""
    make_directory(out)
    with counted(data.PARTS) as advance:
        paper = compute(advance)
    compared = rows(paper)
    results = numbers(paper, compared)
    publish(
        Path(__file__).parent,
        out,
        {name: draw(paper) for name, draw in figures.DRAWINGS.items()},
        results,
        claims=judge(paper),
        as_json=as_json,
        rows=compared,
        maxima_apart=MAXIMA_APART,
        **{name: results[name] for name in ("cells", "maxima", "fronts", "readings", "moduli", "patterns")},
    )


def numbers(paper: PaperB, compared: Sequence[PrintedDifference]) -> dict[str, Any]:
    """Return the numbers of the page in SI units; differences are relative."""
    return {
        "cells": paper.cells,
        "differences": [
            {**asdict(row.printed), "reference": row.reference, "grids_apart": row.grids_apart, "agrees": row.agrees}
            | asdict(row.found)
            for row in compared
        ],
        "films": {
            name: {
                law: {
                    "load": film.load,
                    "load_coarser": paper.coarser[name][law].load,
                    "peak": film.peak,
                    "start": film.start,
                    "rupture": film.rupture,
                }
                for law, film in films.items()
            }
            for name, films in paper.films.items()
        },
        "fronts": {case: 1e3 * front_apart(paper, case, law) for case, law in FRONTS.items()},
        "maxima": {law: maxima(film) for law, film in paper.films["twin"].items()},
        "readings": {
            inlet: {name: _reading(paper, name, inlet) for name in ("single", "twin")} for inlet in data.READINGS
        },
        "moduli": {
            law: {case: paper.found[case, law, "p"][0].integrals for case in ("starved", "gap")}
            for law in (CONSTANT, ROUNDED, COARSE)
        },
        "patterns": [
            {
                "pattern": name,
                "inlet": inlet,
                "load": film.load,
                "load_coarser": paper.coarser_patterns[name, inlet].load,
                "peak": film.peak,
                "cavitated": float(film.weights[film.theta < 1].sum() / film.weights.sum()),
            }
            for (name, inlet), film in paper.patterns.items()
        ],
        "sweeps": paper.sweeps,
    }


def front_apart(paper: PaperB, case: str, law: str) -> float:
    """Return how far downstream of the reference a film begins, m."""
    films = paper.films[case]
    reference = next(iter(films.values()))
    return (films[law].start - reference.start) * float(reference.x[-1])


def _reading(paper: PaperB, case: str, inlet: str) -> dict[str, float]:
    films = paper.readings[case, inlet]
    reference, other = (films[law] for law in data.CASES[case].laws)
    return asdict(difference(other.pressure, reference.pressure, reference.weights))


if __name__ == "__main__":
    run_alone(command)
