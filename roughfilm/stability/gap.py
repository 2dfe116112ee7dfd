"""The map of the models of a rough gap, judged by exact Stokes flow or by finer meshes."""

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from roughfilm.batch.answers import answers_to
from roughfilm.batch.executors import local
from roughfilm.batch.jobs import Failure, Job
from roughfilm.contact.foundation.errors import InputError
from roughfilm.figures.base import svg
from roughfilm.figures.views.rough_gap import STYLES
from roughfilm.rom.ladder.result import Result
from roughfilm.stability.checks.gap import JUDGED, Coefficients, agreeing, exact_stokes, exact_thin, extrapolated
from roughfilm.stability.form import (
    GOOD,
    SECOND_TRY,
    MapOutcome,
    Spot,
    Spots,
    StabilityMap,
    count,
    failed,
    in_groups,
    in_rows,
)
from roughfilm.stability.pocket import available_models
from roughfilm.stability.questions.gap import CUT, CUTS, GapProbe, gap_runs

MIN_COLUMNS, MAX_COLUMNS = 32, 64
"""Smallest and largest resolution of the map."""

ALLOWED_ERROR = 0.05
"""Relative error of a coefficient above which it is inaccurate."""

MIN_COEFFICIENT = 1e-3
"""Least coefficient, over that of a smooth gap, that relative errors refer to; smaller ones are replaced by it."""

SLOW_ITERATIONS = {"homogenized": 100, "slope_corrected": 100, "stokes": 600, "navier_stokes": 600}
"""Number of iterations of all drives together above which a run is slow, by model."""

ROUND_OFF = 1e-9
"""Allowed excess of an error over the uncertainty."""

UNJUDGED = "no reference"
"""The reason (``why``) of a run that converged and has no error, because nothing is known to judge it by."""

TOO_SMALL = "uncertainty too small"
SLOPE_LEFT_OUT = "slope left out"
CUT_OUT = "contact cut out"
REPORTED = "reported"
NOT_REPORTED = "not reported"


def spot_of(
    run: GapProbe, answer: Result | Failure, truth: Coefficients | None, thin: Coefficients | None = None
) -> Spot:
    """The judged answer to a run.

    Parameters
    ----------
    run, answer : the run and its result or failure.
    truth : coefficients that errors refer to: Stokes flow, or the best that is known; None if nothing is known.
    thin : coefficients of thin-film theory, which the uncertainties of ``homogenized`` refer to, and which has the
        largest flow and the least friction of all flows; None for a pressed wall.
    """
    place: dict[str, Any] = {"group": run.group, "row": run.row, "column": run.column}
    cells = _cell_shape(run)
    if isinstance(answer, Failure):
        blank: dict[str, float | None] = dict.fromkeys(("imbalance", *JUDGED))
        spot = failed(answer, **place, numbers=blank)
        return replace(spot, message=f"{spot.message} {cells}".strip())
    values = {name: answer[name].value for name in JUDGED if name in answer.quantities}
    imbalance = max((one.imbalance for one in answer.numerics.runs if one.imbalance is not None), default=None)
    spot = Spot(
        **place,
        outcome=MapOutcome.CONVERGED,
        why="" if truth else UNJUDGED,
        iterations=answer.numerics.iterations,
        cpu_s=answer.numerics.cpu_s,
        message=cells,
        numbers={"imbalance": imbalance, **{name: values.get(name) for name in JUDGED}},
    )
    worst = ""
    if truth:
        errors = {
            name: abs(values[name] - right) / max(abs(right), MIN_COEFFICIENT)
            for name, right in truth.values.items()
            if name in values
        }
        worst = max(errors, key=lambda name: errors[name])
        spot = replace(spot, error=errors[worst], message=f"{worst} judged by {truth.source} {cells}".strip())
    homogenized = run.setting.model.name == "homogenized"
    uncertainties = {name: one.uncertainty for name, one in answer.quantities.items() if one.uncertainty is not None}
    warned = bool(answer.warnings)
    if message := _too_small(values, uncertainties, thin if homogenized else truth):
        return replace(spot, outcome=MapOutcome.WRONG, why=TOO_SMALL, message=message)
    if thin and not homogenized and (message := _impossible(values, uncertainties, thin)):
        outcome, why = (MapOutcome.INACCURATE, REPORTED) if warned else (MapOutcome.WRONG, NOT_REPORTED)
        return replace(spot, outcome=outcome, why=why, message=f"{message}; {spot.message}".strip("; "))
    if spot.error is not None and spot.error > ALLOWED_ERROR:
        reported = SLOPE_LEFT_OUT if homogenized else REPORTED
        why = reported if warned or (worst in uncertainties and not homogenized) else NOT_REPORTED
        why = CUT_OUT if run.wave is None else why
        return replace(spot, outcome=MapOutcome.WRONG if why == NOT_REPORTED else MapOutcome.INACCURATE, why=why)
    if any(one.recipe for one in answer.numerics.runs):
        return replace(spot, outcome=MapOutcome.SLOW, why=SECOND_TRY)
    slow = (spot.iterations or 0) > SLOW_ITERATIONS[answer.model]
    return replace(spot, outcome=MapOutcome.SLOW if slow else MapOutcome.CONVERGED)


def _too_small(values: Mapping[str, float], uncertainties: Mapping[str, float], truth: Coefficients | None) -> str:
    """The uncertainties that do not cover the error, in words; "" if all cover it."""
    if truth is None:
        return ""
    judged = [name for name in truth.values if name in uncertainties and name in values]
    errors = {name: abs(values[name] - truth.values[name]) for name in judged}
    return ", ".join(
        f"{name}: error {error:.2g}, uncertainty {uncertainties[name]:.2g}"
        for name, error in errors.items()
        if error > uncertainties[name] + truth.uncertainties[name] + ROUND_OFF
    )


def _impossible(values: Mapping[str, float], uncertainties: Mapping[str, float], thin: Coefficients) -> str:
    """A flow larger, or a friction smaller, than that of thin films, in words; "" if there is none."""
    for name, sign in (("A11", 1), ("A22", 1), ("friction", -1)):
        if name not in values:
            continue
        right = thin.values[name]
        slack = ALLOWED_ERROR * max(right, MIN_COEFFICIENT) + thin.uncertainties[name] + uncertainties.get(name, 0.0)
        if sign * (values[name] - right) > slack:
            words = "more flow" if sign > 0 else "less friction"
            return f"{words} than is possible: {name} is {values[name]:.3g}, {right:.3g} by thin-film theory"
    return ""


def _cell_shape(run: GapProbe) -> str:
    """The ratio of the length of the cells to their thickness, in words; "" for a run without a mesh over a wave."""
    if run.wave is None or run.setting.resolution is None or run.scene.layers is None:
        return ""
    return f"(cells {run.wave.wavelength / run.setting.resolution * run.scene.layers:.3g} times as long as thick)"


GapAnswer = tuple[GapProbe, Result | Failure]


def solve(resolution: int, out: Path, processes: int, scratch: Path) -> Spots:
    """The judged spots of all runs, and the absent models; InputError if the resolution is odd.

    The arguments are those of ``StabilityMap.solve``.
    """
    if resolution % 2:
        raise InputError(f"--resolution: got {resolution}; {GAP.allowed}")
    here, absent = available_models("rough_gap")
    runs = list(gap_runs(here, resolution))
    jobs = [
        Job(scene=run.scene, setting=run.setting, path=out / "runs" / run.place / f"{run.setting.name}.h5")
        for run in runs
    ]
    answers = answers_to(list({job.path: job for job in jobs}.values()), processes, scratch)
    with local(processes, scratch) as executor:
        return judged([(run, answers[job.path]) for run, job in zip(runs, jobs, strict=True)], executor), absent


def judged(answers: Sequence[GapAnswer], executor: Executor) -> list[Spot]:
    """The spots of answers, judged by the theory for their wave, by two meshes, or by the smallest cut."""
    waves = list(dict.fromkeys(run.wave for run, _ in answers if run.wave))
    thin = dict(zip(waves, executor.map(exact_thin, waves), strict=True))
    stokes = dict(zip(waves, executor.map(exact_stokes, waves), strict=True))
    meshes = _two_meshes(answers)
    spots = []
    for run, answer in answers:
        if run.wave is None:
            spots.append(spot_of(run, answer, _at_least_cut(run, answers)))
            continue
        inertia = run.setting.model.name == "navier_stokes"
        truth = None if inertia else stokes[run.wave]
        if truth is None:
            truth = meshes.get((run.place, "navier_stokes" if inertia else "stokes"))
            truth = truth if run.setting.resolution else agreeing(truth)
        spots.append(spot_of(run, answer, truth, thin[run.wave]))
    return spots


def _two_meshes(answers: Sequence[GapAnswer]) -> dict[tuple[str, str], Coefficients]:
    """The limits of two meshes by scene and model, where both meshes have an answer."""
    results: dict[tuple[str, str], dict[int, Result]] = {}
    for run, answer in answers:
        setting = run.setting
        if isinstance(answer, Result) and setting.resolution and setting.scheme != "upwind":
            results.setdefault((run.place, setting.model.name), {})[setting.resolution] = answer
    return {key: extrapolated(own[min(own)], own[max(own)]) for key, own in results.items() if len(own) == 2}


def _at_least_cut(run: GapProbe, answers: Sequence[GapAnswer]) -> Coefficients | None:
    """The coefficients A of the same setting at the smallest cut; errors against them are those of cutting out more.

    The uncertainties are infinite, because those of the model are common to both answers and do not count.
    """
    place = (run.group, run.row, f"{min(CUTS):g}")
    least = next(answer for other, answer in answers if (other.group, other.row, other.column) == place)
    if isinstance(least, Failure):
        return None
    values = {name: least[name].value for name in ("A11", "A22")}
    source = f"its own answer at a smallest gap of {place[-1]}"
    return Coefficients(values=values, uncertainties=dict.fromkeys(values, np.inf), source=source)


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: where each group is inaccurate, stalled or wrong, and the balance of the wall forces."""
    lines = []
    for group, own in in_groups(spots).items():
        words = dict.fromkeys(spot.why or spot.outcome for spot in own if spot.outcome not in GOOD)
        faults = [
            f"{word} at {_places([spot for spot in own if (spot.why or spot.outcome) == word])}" for word in words
        ]
        lines.append("; ".join([f"{group}: good at {count(own, *GOOD)} of {len(own)} places", *faults]) + ".")
    held = [(imbalance, spot) for spot in spots if (imbalance := spot.numbers["imbalance"]) is not None]
    if held:
        most, worst = max(held, key=lambda pair: pair[0])
        lines.append(
            f"The forces of walls and pressure balance within {most:.1e} of the drag of a smooth gap in all "
            f"{len(held)} resolved answers; the worst is {worst.place}."
        )
    return lines


def _places(spots: Sequence[Spot]) -> str:
    return "; ".join(f"{row} with {', '.join(cells)}" for row, cells in in_rows(spots).items())


def against_cut(spots: Sequence[Spot]) -> str:
    """The figure of A11 and friction against the smallest gap, for every pressed wall and setting, as SVG text."""
    groups = {name: own for name, own in in_groups(spots).items() if name.startswith(f"{CUT}:")}
    figure = Figure(figsize=(10, 5.6), layout="constrained")
    panels = figure.subplots(2, len(groups), sharex=True, squeeze=False)
    for (name, own), column in zip(groups.items(), panels.T, strict=True):
        rows = in_rows(own)
        finest = max((int(columns) for row in rows if (columns := row.partition("-")[2])), default=0)
        for quantity, axes in zip(("A11", "friction"), column, strict=True):
            for setting, cells in rows.items():
                model, _, columns = setting.partition("-")
                known = [(float(c), value) for c, s in cells.items() if (value := s.numbers[quantity]) is not None]
                if known:
                    axes.plot(
                        *zip(*known, strict=True),
                        STYLES[model].marker,
                        color=STYLES[model].colour,
                        linestyle="-" if columns in ("", str(finest)) else ":",
                        label=f"{model}, {columns} columns" if columns else model,
                    )
            axes.set_xscale("log")
            axes.set_ylim(0, 1.1 * axes.dataLim.ymax if axes.has_data() else 1)
        column[0].set_title(name.removeprefix(f"{CUT}: "), fontsize=10)
        column[1].set_xlabel("smallest open gap, over the mean gap")
    panels[0, 0].set_ylabel("A11, over a smooth gap's")
    panels[1, 0].set_ylabel("friction, over a smooth gap's")
    panels[0, -1].legend(fontsize=8)
    return svg(figure)


GAP = StabilityMap(
    name="rough_gap",
    title="Rough gaps in three dimensions",
    axes="A gap of mean height h between a flat wall, which also slides, and ridges a cos(2πx/L), bumps "
    "a cos(2πx/L) cos(2πy/L) (a and L over h), or a wall pressed against it: distance of the walls (columns: "
    "the least distance, over h), slope, contact (columns: the smallest gap that is open, over h), shape of cells, "
    "inertia. OpenFOAM has {resolution} mesh columns unless a row says otherwise, with a quarter as many layers.",
    judge=f"The error is the largest relative error of the coefficients {', '.join(JUDGED)}, by exact "
    "Stokes flow where it is known, else by the limit of two meshes; for pressed walls that of A against the "
    f"smallest gap of all. Good is within {ALLOWED_ERROR:.0%} and within the uncertainty; uncertainties of "
    "homogenized, which leaves out slope, refer to thin-film theory. Iterations are those of all drives; slow is above "
    f"{SLOW_ITERATIONS['homogenized']} of thin films, {SLOW_ITERATIONS['stokes']} of OpenFOAM.",
    resolution=MIN_COLUMNS,
    resolution_meaning="mesh columns of OpenFOAM's finest bumps, half as many as of its finest ridges",
    least=MIN_COLUMNS,
    most=MAX_COLUMNS,
    allowed=f"it must be even, {MIN_COLUMNS} to {MAX_COLUMNS}",
    solve=solve,
    summary=summary,
    draw=lambda spots: {"against_cut": against_cut(spots)},
)
