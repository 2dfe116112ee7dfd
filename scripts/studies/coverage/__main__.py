"""Judge the uncertainties of all models by independent solutions: python -m scripts.studies.coverage --out OUT.

Every finished scene is one line of ``OUT/coverage_KIND.jsonl``. The command goes on where it was stopped.
"""

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from statistics import median
from typing import Annotated

import numpy as np
import typer
from matplotlib.figure import Figure
from rich.table import Table

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.figures.base import new_figure
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.coverage.advising import advised
from scripts.studies.coverage.answering import answers, code_and_laws
from scripts.studies.coverage.drawing import FIRST_SEED, drawn, part_of, seeds
from scripts.studies.coverage.judge import (
    ADVICE_GOAL,
    FAR,
    GOAL,
    SHARE,
    WIDE,
    AdviceScore,
    Coverage,
    Finding,
    advice_scores,
    coverage,
    findings,
    silences,
)
from scripts.studies.coverage.store import Advised, Answer, Judged, append, path_of, read
from scripts.studies.coverage.truth import kinds_with_truth, truth_of
from scripts.studies.study import Out, counted, publish

ROUNDING = 1e-9
"""Relative difference up to which two answers are the same."""


def judged(kind: str, seed: int, known: Judged | None, with_advice: bool) -> Judged:
    """Return a scene with its truth and the answers of today; with advice, models in OpenFOAM answer too.

    The truth is taken from a known one of the same scene, unless models gave it themselves and their answers moved.
    """
    scene = drawn(kind, seed)
    if known is None or scene_entries(read_scene(known.scene)) != scene_entries(scene):
        known = with_truth(kind, seed, scene)
    if known.failure:
        return replace(known, code=code_and_laws(kind))
    found = answers(scene, outside=with_advice)
    if moved(known, found):
        known = with_truth(kind, seed, scene)
    advice = advised(scene) if with_advice else ()
    return replace(known, models=found, advice=advice, code=code_and_laws(kind))


def with_truth(kind: str, seed: int, scene: Scene) -> Judged:
    """Return a scene with its truth, or with the reason why there is none."""
    begun = time.process_time()
    known = Judged(kind=kind, seed=seed, scene=scene_entries(scene), truth={})
    try:
        truth = truth_of(scene, kind)
    except (ConvergenceError, InputError) as error:  # of a load that no film carries
        return replace(known, failure=str(error))
    return replace(
        known,
        truth={name: (value, truth.uncertainty[name]) for name, value in truth.values.items()},
        own=truth.own,
        by=truth.by,
        runs=truth.runs,
        finer=truth.finer,
        method=truth.method,
        truth_warnings=truth.warnings,
        truth_cpu_s=time.process_time() - begun,
    )


def moved(known: Judged, found: Mapping[str, Answer]) -> bool:
    """Return whether an answer differs from the known one by so much that a truth by its own model cannot judge it.

    The limit is ``SHARE`` of the lower uncertainty, or ``ROUNDING``.
    """
    for model, true in known.own.items():
        before, now = known.models.get(model, Answer()), found.get(model, Answer())
        for quantity in true.keys() & before.values.keys() & now.values.keys():
            bars = [one.uncertainty.get(quantity, 0.0) for one in (before, now)]
            value, other = before.values[quantity], now.values[quantity]
            if abs(value - other) > max(SHARE * min(bars), ROUNDING * abs(value)):
                return True
    return False


def missing(out: Path, kind: str, scenes: int, advice: int) -> Iterator[tuple[int, Judged | None, bool]]:
    """Return the seeds that the file lacks, or whose answers older code gave: with what is known, and if to advise."""
    stored = read(path_of(out, kind))
    for seed in seeds(scenes):
        known, wanted = stored.get(seed), part_of(seed) == "check" and seed - FIRST_SEED["check"] < advice
        if known is None or known.code != code_and_laws(kind) or (wanted and not known.advice and not known.failure):
            yield seed, known, wanted


def chosen(kinds: str | None) -> Sequence[str]:
    """Return the kinds named in a text with commas, or all kinds that the study knows."""
    known = kinds_with_truth()
    names = known if kinds is None else tuple(kinds.split(","))
    if unknown := [name for name in names if name not in known]:
        raise InputError(f"--kinds: got {unknown[0]!r}; it must be among {', '.join(known)}, joined by commas")
    return names


def figure(found: Sequence[Finding]) -> Figure:
    """Draw the share of answers below every multiple of what they state, a panel for each kind."""
    kinds = list(dict.fromkeys(one.kind for one in found))
    drawn, panels = new_figure((10, 3.4 * max((len(kinds) + 1) // 2, 1)), max((len(kinds) + 1) // 2, 1), 2)
    for axes, kind in zip(np.ravel(panels), kinds, strict=False):
        for model in dict.fromkeys(one.model for one in found if one.kind == kind):
            ratios = [
                one.error / one.stated for one in found if (one.kind, one.model) == (kind, model) and one.stated > 0
            ]
            axes.plot(np.sort(np.maximum(ratios, 1e-3)), np.linspace(0, 1, len(ratios)), label=model)
        axes.plot([1e-3, 1, 1], [0.95, 0.95, 0], color="0.4", linestyle=":", linewidth=0.8)
        axes.set(
            xscale="log", xlim=(1e-3, 1e2), title=kind, xlabel="error over what is stated", ylabel="share of answers"
        )
        axes.legend(fontsize=7)
    return drawn


def table(rows: Sequence[Coverage]) -> Table:
    """Return the coverage as a printed table."""
    shown = Table(
        "kind", "model", "quantity", "promise", "kept", "goal", "misleading", "undecided", "stated/error", "wide"
    )
    for one in rows:
        kept = f"{one.kept} of {one.judged}" + (f" ({one.share:.1%})" if one.judged else "")
        cells = (one.kind, one.model, one.quantity, one.promise, kept, one.verdict, str(one.misleading))
        shown.add_row(*cells, str(one.undecided), f"{one.width:.2g}", f"{one.wide_share:.0%}")
    return shown


def advice_table(scores: Sequence[AdviceScore]) -> Table:
    """Return the scores of the advice as a printed table."""
    shown = Table("kind", "quantity", "within", "kept", "refused", "cost over the best model's")
    for one in scores:
        kept = f"{one.kept} of {one.judged}" + (f" ({one.share:.1%})" if one.judged else "")
        shown.add_row(one.kind, one.quantity, f"{one.within:.0%}", kept, str(one.refused), f"{one.cost:.2%}")
    return shown


@in_one_line
def command(
    out: Out,
    scenes: Annotated[int, typer.Option(help="Scenes of each kind; every second one is to check.")] = 400,
    kinds: Annotated[str | None, typer.Option(help="Kinds, joined by commas (default: all).")] = None,
    advice: Annotated[int, typer.Option(help="Scenes of each kind for which advice is asked and OpenFOAM runs.")] = 40,
    as_json: AsJson = False,
) -> None:
    """Solve random scenes by all models and by independent methods, and compare the errors with what is stated."""
    make_directory(out)
    names = chosen(kinds)
    work = [(kind, *one) for kind in names for one in missing(out, kind, scenes, advice)]
    with counted(len(work)) as advance:
        for kind, seed, known, wanted in work:
            advance(f"{kind} {seed}")
            append(path_of(out, kind), judged(kind, seed, known, wanted))
    wanted_seeds = {seed for seed in seeds(scenes) if part_of(seed) == "check"}
    judged_scenes = [
        one for kind in names for seed, one in sorted(read(path_of(out, kind)).items()) if seed in wanted_seeds
    ]
    found = list(findings(judged_scenes))
    rows = coverage(found)
    scores, advice_misses = advice_scores(judged_scenes)
    misses = [one for one in found if one.decided and not one.kept]
    publish(
        Path(__file__).parent,
        out,
        {"coverage": figure(found)},
        {
            "coverage": [{**asdict(one), "share": one.share, "verdict": one.verdict} for one in rows],
            "advice": [{**asdict(one), "share": one.share} for one in scores],
            "silent": silences(judged_scenes),
            "misses": misses,
            "advice_misses": [
                {"kind": scene.kind, "seed": scene.seed, **asdict(one)} for scene, one, _ in advice_misses
            ],
            "provenance": circumstances(),
        },
        tables=[
            table(rows),
            advice_table(scores),
            *(f"missed: {miss(one)}" for one in misses),
            *(f"missed: {advice_miss(*one)}" for one in advice_misses),
        ],
        as_json=as_json,
        counts=counts_of(judged_scenes),
        silent=silences(judged_scenes),
        rows=rows,
        scores=scores,
        misses=misses,
        advice_misses=advice_misses,
        goal=GOAL,
        far=FAR,
        wide=WIDE,
        advice_goal=ADVICE_GOAL,
        provenance=circumstances(),
    )


def counts_of(scenes: Sequence[Judged]) -> dict[str, dict[str, float]]:
    """Return the number of scenes by kind, those without a truth, and the CPU time of a truth, s."""
    return {
        kind: {
            "scenes": sum(one.kind == kind for one in scenes),
            "failed": sum(one.kind == kind and bool(one.failure) for one in scenes),
            "cpu_s": median(one.truth_cpu_s for one in scenes if one.kind == kind),
        }
        for kind in dict.fromkeys(one.kind for one in scenes)
    }


def miss(one: Finding) -> str:
    """Return an answer that does not keep what it states, in words."""
    return (
        f"{one.kind} {one.seed}, {one.quantity} by {one.model}: {one.value:.5g}, true {one.true:.5g} ± "
        f"{one.truth_uncertainty:.2g}; {one.promise} {one.stated:.2g}" + (" (warned)" if one.warned else "")
    )


def advice_miss(scene: Judged, one: Advised, error: float) -> str:
    """Return an advised answer beyond its tolerance, in words."""
    expected = "" if one.expected is None else f", expected {one.expected:.2%}"
    return f"{scene.kind} {scene.seed}, {one.quantity} within {one.within:.0%}: {one.model}, {error:.2%} off{expected}"


if __name__ == "__main__":
    run_alone(command)
