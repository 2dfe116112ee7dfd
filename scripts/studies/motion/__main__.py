"""Count how often the uncertainties of films whose walls move hold: python -m scripts.studies.motion --out OUT.

Random bearings are solved on a coarse grid, by `solve`, `dynamics` and `march`, and on finer ones. Films with
temperatures are counted by `--commands heated_dynamics,heat_balance,adiabatic,across`.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from itertools import product
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from matplotlib.figure import Figure
from rich.table import Table

from roughfilm.contact.foundation.errors import InputError
from roughfilm.figures.base import new_figure
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.coverage.judge import FAR, GOAL, Coverage, Finding, coverage
from scripts.studies.motion.counting import (
    DYNAMICS,
    HEATED_DYNAMICS,
    MARCH,
    SOLVE,
    THERMAL,
    Counted,
    count_scene,
    counted_of,
)
from scripts.studies.motion.random_scenes import HEATED, IN_TIME, KINDS
from scripts.studies.study import Out, counted, kept, publish

ALL = "all"
"""Kind of the rows over all kinds."""

USUAL = (SOLVE, MARCH)
"""What a scene is asked by default; the equilibrium comes with its stiffness and damping."""

COMMANDS = (*USUAL, HEATED_DYNAMICS, *THERMAL)
"""All that a scene can be asked; the last ones solve another scene, whose lubricant heats."""


KINDS_OF = {SOLVE: tuple(KINDS), MARCH: IN_TIME, HEATED_DYNAMICS: tuple(KINDS), **dict.fromkeys(THERMAL, tuple(HEATED))}
"""Kinds of scenes by what they are asked."""


@dataclass(frozen=True, kw_only=True)
class Tally:
    """The scenes of a kind that were solved or marched, and those of them that were refused or do not converge."""

    kind: str
    command: str
    scenes: int
    refused: int
    silent: int


@in_one_line
def command(
    out: Out,
    scenes: Annotated[int, typer.Option(min=1, help="Random scenes of each kind.")] = 16,
    first: Annotated[int, typer.Option(min=0, help="First seed.")] = 0,
    kinds: Annotated[str | None, typer.Option(help="Kinds, joined by commas (default: all).")] = None,
    commands: Annotated[
        str | None, typer.Option(help=f"Of {', '.join(COMMANDS)}, joined by commas (default: solve,march).")
    ] = None,
    cells: Annotated[int, typer.Option(min=32, help="Cells along the film of an equilibrium.")] = 48,
    march_cells: Annotated[int, typer.Option(min=16, help="Cells along the film of a march.")] = 32,
    as_json: AsJson = False,
) -> None:
    """Compare the uncertainties of equilibria, of stiffness and damping, and of marches with the errors."""
    make_directory(out)
    work = [
        (kind, seed, asked)
        for asked, kind, seed in product(
            chosen("commands", commands or ",".join(USUAL), COMMANDS),
            chosen("kinds", kinds, tuple(HEATED)),
            range(first, first + scenes),
        )
        if kind in KINDS_OF[asked]
    ]
    results = []
    with counted(len(work)) as advance:
        for kind, seed, asked in work:
            advance(f"{asked} {kind} {seed}")
            grid = march_cells if asked == MARCH else cells
            results.append(counted_of(count(out / "scenes", kind, seed, asked, grid)))
    found = [one for result in results for one in result.found]
    rows = by_quantity(found)
    tallies = tallies_of(results)
    misses = [one for one in found if one.decided and not one.kept]
    publish(
        Path(__file__).parent,
        out,
        {"motion": figure(found)},
        {
            "coverage": [{**asdict(one), "share": one.share, "verdict": one.verdict} for one in rows],
            "scenes": tallies,
            "refused": [
                {"kind": one.kind, "seed": one.seed, "command": one.command, "reason": one.refused}
                for one in results
                if one.refused
            ],
            "misses": misses,
            "cells": {**dict.fromkeys((SOLVE, DYNAMICS, HEATED_DYNAMICS, *THERMAL), cells), MARCH: march_cells},
            "provenance": circumstances(),
        },
        tables=[table(rows), *(f"missed: {miss(one)}" for one in misses), *map(words, tallies)],
        as_json=as_json,
        rows=rows,
        misses=misses,
        tallies=tallies,
        goal=GOAL,
        far=FAR,
        provenance=circumstances(),
    )


def count(folder: Path, kind: str, seed: int, asked: str, cells: int) -> dict[str, object]:
    """Return what a scene gives, from its file if that was made by the same code."""
    inputs = {"kind": kind, "seed": seed, "command": asked, "cells": cells}
    path = folder / f"{asked}_{kind}_{seed}_{cells}.json"
    return dict(kept(path, inputs, lambda: count_scene(kind, seed, asked, cells)))


def chosen(option: str, given: str | None, known: Sequence[str]) -> Sequence[str]:
    """Return the names in a text with commas, or all of them; InputError for one that is not known."""
    names = known if given is None else tuple(given.split(","))
    if unknown := [name for name in names if name not in known]:
        raise InputError(f"--{option}: got {unknown[0]!r}; it must be among {', '.join(known)}, joined by commas")
    return names


def by_quantity(found: Sequence[Finding]) -> list[Coverage]:
    """Return the coverage of each quantity of a command over all kinds, and that of all quantities together."""
    together = [replace(one, kind=ALL) for one in found]
    return sorted(coverage(together), key=lambda one: (one.model, one.quantity)) + coverage(
        [replace(one, quantity="all quantities") for one in together]
    )


def tallies_of(results: Sequence[Counted]) -> list[Tally]:
    """Return the number of scenes, of refused ones, and of those with a number without an uncertainty."""
    groups: dict[tuple[str, str], list[Counted]] = {}
    for one in results:
        groups.setdefault((one.kind, one.command), []).append(one)
    return [
        Tally(
            kind=kind,
            command=asked,
            scenes=len(group),
            refused=sum(bool(one.refused) for one in group),
            silent=sum(any(one.silent.values()) for one in group),
        )
        for (kind, asked), group in groups.items()
    ]


def words(one: Tally) -> str:
    """Return the numbers of scenes of a kind in words."""
    return (
        f"{one.command} {one.kind}: {one.scenes} scenes, {one.refused} without an answer or a truth, {one.silent} with "
        "numbers without an uncertainty"
    )


def table(rows: Sequence[Coverage]) -> Table:
    """Return the coverage as a printed table."""
    shown = Table("command", "quantity", "kept", "goal", "misleading", "undecided", "stated/error")
    for one in rows:
        held = f"{one.kept} of {one.judged}" + (f" ({one.share:.1%})" if one.judged else "")
        shown.add_row(
            one.model, one.quantity, held, one.verdict, str(one.misleading), str(one.undecided), f"{one.width:.2g}"
        )
    return shown


def miss(one: Finding) -> str:
    """Return a number outside of its uncertainty, in words."""
    return (
        f"{one.kind} {one.seed}, {one.quantity} by {one.model}: {one.value:.6g}, true {one.true:.6g} ± "
        f"{one.truth_uncertainty:.2g}; uncertainty {one.stated:.2g}" + (" (warned)" if one.warned else "")
    )


def figure(found: Sequence[Finding]) -> Figure:
    """Draw the share of the numbers below every multiple of their uncertainty, a line for each command."""
    drawing, axes = new_figure((6, 3.6))
    for name in dict.fromkeys(one.model for one in found):
        ratios = [one.error / one.stated for one in found if one.model == name and one.stated > 0]
        axes.plot(np.sort(np.maximum(ratios, 1e-3)), np.linspace(0, 1, len(ratios)), label=name)
    axes.plot([1e-3, 1, 1], [0.95, 0.95, 0], color="0.4", linestyle=":", linewidth=0.8)
    axes.set(xscale="log", xlim=(1e-3, 1e2), xlabel="error over uncertainty", ylabel="share of numbers")
    axes.legend()
    return drawing


if __name__ == "__main__":
    run_alone(command)
