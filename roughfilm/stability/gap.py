"""Where the models of a rough gap converge, and how they fail elsewhere: judged by exact flow, or by finer meshes."""

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
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
from roughfilm.ladder import models
from roughfilm.rom.ladder.result import Result
from roughfilm.stability.checks.gap import JUDGED, Truth, agreeing, exact_stokes, exact_thin, extrapolated
from roughfilm.stability.form import GOOD, SECOND, Map, Outcome, Spot, count, failed, in_groups, in_rows
from roughfilm.stability.questions.gap import CUT, CUTS, Probe, probes

KIND = "rough_gap"
FEWEST, MOST = 32, 64

ALLOWED = 0.05
"""A larger part of a coefficient than this is inaccurate."""

LEAST = 1e-3
"""Coefficients below this part of a smooth gap's are judged as if they were as large."""

SLOW = {"homogenized": 100, "slope_corrected": 100, "stokes": 600, "navier_stokes": 600}
"""More iterations than this, of all drives together, are slow."""

ROUNDING = 1e-9


UNJUDGED = "nothing finer to judge it by"
"""Why a run that converged has no error."""

TOO_SHORT, LEFT_OUT, CUT_OUT, TOLD, SILENT = (
    "error bar too short",
    "slope left out",
    "contact cut out",
    "told",
    "not told",
)
"""Why an answer is wrong, or inaccurate."""


def spot_of(probe: Probe, answer: Result | Failure, truth: Truth | None, thin: Truth | None = None) -> Spot:
    """The judged answer to a probe.

    The error is by ``truth``, Stokes flow or whatever is the best at hand. ``thin`` is thin-film theory: what the error
    bars of ``homogenized`` are about, and of all flows that with the most flow and the least friction.
    """
    place: dict[str, Any] = {"group": probe.group, "row": probe.row, "column": probe.column}
    cells = _cells(probe)
    if isinstance(answer, Failure):
        blank: dict[str, float | None] = dict.fromkeys(("imbalance", *JUDGED))
        spot = failed(answer, **place, numbers=blank)
        return replace(spot, message=f"{spot.message} {cells}".strip())
    values = {name: answer.quantities[name].value for name in JUDGED if name in answer.quantities}
    imbalance = max((run.imbalance for run in answer.numerics.runs if run.imbalance is not None), default=None)
    spot = Spot(
        **place,
        outcome=Outcome.CONVERGED,
        why="" if truth else UNJUDGED,
        iterations=answer.numerics.iterations,
        cpu_s=answer.numerics.cpu_s,
        message=cells,
        numbers={"imbalance": imbalance, **{name: values.get(name) for name in JUDGED}},
    )
    worst = ""
    if truth:
        parts = {n: abs(values[n] - right) / max(abs(right), LEAST) for n, right in truth.values.items() if n in values}
        worst = max(parts, key=lambda name: parts[name])
        spot = replace(spot, error=parts[worst], message=f"{worst} judged by {truth.source} {cells}".strip())
    plain = probe.setting.model.name == "homogenized"
    bars = {name: one.uncertainty for name, one in answer.quantities.items() if one.uncertainty is not None}
    warned = bool(answer.warnings)
    if short := _short(values, bars, thin if plain else truth):
        return replace(spot, outcome=Outcome.WRONG, why=TOO_SHORT, message=short)
    if thin and not plain and (beyond := _beyond(values, bars, thin)):
        outcome, why = (Outcome.INACCURATE, TOLD) if warned else (Outcome.WRONG, SILENT)
        return replace(spot, outcome=outcome, why=why, message=f"{beyond}; {spot.message}".strip("; "))
    if spot.error is not None and spot.error > ALLOWED:
        why = CUT_OUT if probe.wave is None else LEFT_OUT if plain else TOLD if warned or worst in bars else SILENT
        return replace(spot, outcome=Outcome.WRONG if why == SILENT else Outcome.INACCURATE, why=why)
    if any(run.recipe for run in answer.numerics.runs):
        return replace(spot, outcome=Outcome.SLOW, why=SECOND)
    slow = (spot.iterations or 0) > SLOW[answer.model]
    return replace(spot, outcome=Outcome.SLOW if slow else Outcome.CONVERGED)


def _short(values: Mapping[str, float], bars: Mapping[str, float], right: Truth | None) -> str:
    """Which error bars are too short, in words."""
    if right is None:
        return ""
    errors = {name: abs(values[name] - right.values[name]) for name in right.values if name in bars and name in values}
    short = [name for name, error in errors.items() if error > bars[name] + right.off[name] + ROUNDING]
    return ", ".join(f"{name} off by {errors[name]:.2g}, its bar is {bars[name]:.2g}" for name in short)


def _beyond(values: Mapping[str, float], bars: Mapping[str, float], thin: Truth) -> str:
    """What is not possible: more flow, or less friction, than in thin films."""
    for name, sign in (("A11", 1), ("A22", 1), ("friction", -1)):
        if name not in values:
            continue
        slack = ALLOWED * max(thin.values[name], LEAST) + thin.off[name] + bars.get(name, 0.0)
        if sign * (values[name] - thin.values[name]) > slack:
            told = "more flow" if sign > 0 else "less friction"
            return (
                f"{told} than is possible: {name} is {values[name]:.3g}, thin-film theory has {thin.values[name]:.3g}"
            )
    return ""


def _cells(probe: Probe) -> str:
    """How long the cells are, over how thick."""
    if probe.wave is None or probe.setting.resolution is None or probe.scene.layers is None:
        return ""
    return f"(cells {probe.wave.wavelength / probe.setting.resolution * probe.scene.layers:.3g} times as long as thick)"


Answered = tuple[Probe, Result | Failure]


@dataclass(frozen=True, kw_only=True)
class GapFamily:
    """The probes of the models of a rough gap."""

    resolution: int = FEWEST
    resolution_meaning: str = "mesh columns of OpenFOAM's finest bumps, half as many as of its finest ridges"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Map:
        """Solve what is not in ``out`` already, and judge all of it."""
        if not FEWEST <= resolution <= MOST or resolution % 2:
            raise InputError(f"--resolution: got {resolution}; it must be even, {FEWEST} to {MOST}")
        ladder = models(KIND)
        absent = {model.name: it.detail for model in ladder if not (it := model.available()).available}
        asked = list(probes([model for model in ladder if model.name not in absent], resolution))
        jobs = [_job(probe, out) for probe in asked]
        answers = answers_to(list({job.path: job for job in jobs}.values()), processes, scratch)
        found = [(probe, answers[job.path]) for probe, job in zip(asked, jobs, strict=True)]
        with local(processes, scratch) as executor:
            spots = judged(found, executor)
        return Map(
            family=KIND,
            title="Rough gaps in three dimensions",
            axes="A gap of mean height h between a flat wall, which also slides, and ridges a cos(2πx/L), bumps "
            "a cos(2πx/L) cos(2πy/L) (a and L over h), or a wall pressed against it: how near the walls come (columns: "
            "the least distance, over h), how steep they are, contact (columns: the smallest gap that is open, over "
            f"h), the shape of cells, inertia. OpenFOAM with {resolution} mesh columns and other numbers of "
            "them as told, "
            "with a quarter as many layers where nothing else is said.",
            judge=f"The error is that of the coefficient ({', '.join(JUDGED)}) that is off most, over itself, by exact "
            "Stokes flow where it is known, else by what two meshes tend to; of pressed walls that of A against the "
            f"smallest gap of all. Good is within {ALLOWED:.0%} and within the error bar told; those of homogenized, "
            "which leaves out slope, are held to thin-film theory. Iterations are those of all drives; slow is above "
            f"{SLOW['homogenized']} of thin films, {SLOW['stokes']} of OpenFOAM.",
            resolution=resolution,
            resolution_meaning=self.resolution_meaning,
            spots=spots,
            told=in_words(spots),
            absent=absent,
            figures={"against_cut": against_cut(spots)},
        )


def _job(probe: Probe, out: Path) -> Job:
    path = out / "runs" / probe.place / f"{probe.setting.name}.h5"
    return Job(scene=probe.scene, setting=probe.setting, path=path)


def judged(found: Sequence[Answered], executor: Executor) -> list[Spot]:
    """Every answer, judged by thin-film theory or Stokes flow of its wave, by two meshes, or by the smallest cut."""
    waves = list(dict.fromkeys(probe.wave for probe, _ in found if probe.wave))
    thin = dict(zip(waves, executor.map(exact_thin, waves), strict=True))
    stokes = dict(zip(waves, executor.map(exact_stokes, waves), strict=True))
    meshes = _two_meshes(found)
    spots = []
    for probe, answer in found:
        model = probe.setting.model.name
        if probe.wave is None:
            spots.append(spot_of(probe, answer, _at_least_cut(probe, found)))
            continue
        truth = stokes[probe.wave] if model != "navier_stokes" else None
        if truth is None:
            truth = meshes.get((probe.place, "navier_stokes" if model == "navier_stokes" else "stokes"))
            truth = truth if probe.setting.resolution else agreeing(truth)
        spots.append(spot_of(probe, answer, truth, thin[probe.wave]))
    return spots


def _two_meshes(found: Sequence[Answered]) -> dict[tuple[str, str], Truth]:
    """By the scene and the model, where both meshes have an answer."""
    runs: dict[tuple[str, str], dict[int, Result]] = {}
    for probe, answer in found:
        setting = probe.setting
        if isinstance(answer, Result) and setting.resolution and setting.scheme != "upwind":
            runs.setdefault((probe.place, setting.model.name), {})[setting.resolution] = answer
    return {key: extrapolated(own[min(own)], own[max(own)]) for key, own in runs.items() if len(own) == 2}


def _at_least_cut(probe: Probe, found: Sequence[Answered]) -> Truth | None:
    """A of the same setting where the least is cut out: the error told is that of cutting out more.

    Error bars of the model do not count here, as both answers are off alike.
    """
    last = f"{min(CUTS):g}"
    least = next(
        answer for other, answer in found if (other.group, other.row, other.column) == (probe.group, probe.row, last)
    )
    if isinstance(least, Failure):
        return None
    values = {name: least.quantities[name].value for name in ("A11", "A22")}
    return Truth(values=values, off=dict.fromkeys(values, np.inf), source=f"its own answer at a smallest gap of {last}")


def in_words(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know: of every group, where it is not good, and how."""
    lines = []
    for group, own in in_groups(spots).items():
        words = dict.fromkeys(spot.why or spot.outcome for spot in own if spot.outcome not in GOOD)
        told = [f"{word} at {_places([spot for spot in own if (spot.why or spot.outcome) == word])}" for word in words]
        lines.append("; ".join([f"{group}: good at {count(own, *GOOD)} of {len(own)} places", *told]) + ".")
    held = [(imbalance, spot) for spot in spots if (imbalance := spot.numbers["imbalance"]) is not None]
    if held:
        most, least = max(held, key=lambda pair: pair[0])
        lines.append(
            f"The walls hold the liquid within {most:.1e} of the drag of a smooth gap in all of {len(held)} resolved "
            f"answers; the worst is {least.place}."
        )
    return lines


def _places(spots: Sequence[Spot]) -> str:
    return "; ".join(f"{row} with {', '.join(cells)}" for row, cells in in_rows(spots).items())


def against_cut(spots: Sequence[Spot]) -> str:
    """A and friction against the smallest gap, of every pressed wall by every setting, as SVG."""
    groups = {name: own for name, own in in_groups(spots).items() if name.startswith(f"{CUT}:")}
    figure = Figure(figsize=(10, 5.6), layout="constrained")
    panels = figure.subplots(2, len(groups), sharex=True, squeeze=False)
    for (name, own), column in zip(groups.items(), panels.T, strict=True):
        finest = max(_columns(own), default=0)
        for quantity, axes in zip(("A11", "friction"), column, strict=True):
            for setting, cells in in_rows(own).items():
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


def _columns(spots: Sequence[Spot]) -> set[int]:
    return {int(columns) for spot in spots if (columns := spot.row.partition("-")[2])}


GAP = GapFamily()
