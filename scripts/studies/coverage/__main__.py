"""Judge the uncertainties of all models by independent solutions: python -m scripts.studies.coverage --out OUT.

Every finished scene is one line of ``OUT/coverage_KIND.jsonl``. The command goes on where it was stopped.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.terminal.console import in_one_line, make_directory, output, run_alone
from scripts.studies.coverage.answering import answers
from scripts.studies.coverage.drawing import drawn, seeds
from scripts.studies.coverage.store import Judged, append, path_of, read
from scripts.studies.coverage.truth import kinds_with_truth, truth_of
from scripts.studies.study import Out, counted


def judged(kind: str, seed: int, known: Judged | None) -> Judged:
    """Return a scene with its truth, which is taken from a known one of the same scene, and the answers of today."""
    scene = drawn(kind, seed)
    entries = scene_entries(scene)
    if known is None or known.scene != entries:
        begun = time.process_time()
        try:
            truth = truth_of(scene)
        except ConvergenceError as error:
            return Judged(kind=kind, seed=seed, scene=entries, truth={}, failure=str(error), code=code())
        known = Judged(
            kind=kind,
            seed=seed,
            scene=entries,
            truth={name: (value, truth.uncertainty[name]) for name, value in truth.values.items()},
            own=truth.own,
            method=truth.method,
            truth_warnings=truth.warnings,
            truth_cpu_s=time.process_time() - begun,
        )
    return replace(known, models={} if known.failure else answers(scene), code=code())


def missing(out: Path, kind: str, scenes: int) -> Iterator[tuple[int, Judged | None]]:
    """Return the seeds that the file lacks, or whose answers older code gave, with what is known of them."""
    stored = read(path_of(out, kind))
    for seed in seeds(scenes):
        if seed not in stored or stored[seed].code != code():
            yield seed, stored.get(seed)


def chosen(kinds: str | None) -> Sequence[str]:
    """Return the kinds named in a text with commas, or all kinds that the study knows."""
    known = kinds_with_truth()
    names = known if kinds is None else tuple(kinds.split(","))
    if unknown := [name for name in names if name not in known]:
        raise InputError(f"--kinds: got {unknown[0]!r}; it must be among {', '.join(known)}, joined by commas")
    return names


@in_one_line
def command(
    out: Out,
    scenes: Annotated[int, typer.Option(help="Scenes of each kind; every second one is to check.")] = 400,
    kinds: Annotated[str | None, typer.Option(help="Kinds, joined by commas (default: all).")] = None,
) -> None:
    """Solve random scenes by all models and by independent methods, and compare the errors with what is stated."""
    make_directory(out)
    names = chosen(kinds)
    work = [(kind, seed, known) for kind in names for seed, known in missing(out, kind, scenes)]
    with counted(len(work)) as advance:
        for kind, seed, known in work:
            advance(f"{kind} {seed}")
            append(path_of(out, kind), judged(kind, seed, known))
    output.print(f"{len(work)} scenes solved")


if __name__ == "__main__":
    run_alone(command)
