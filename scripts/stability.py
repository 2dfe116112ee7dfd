"""roughfilm stability: where each model with each scheme converges, and what becomes of it elsewhere."""

import json
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from contact.errors import InputError
from contact.files import replacing
from foamcases.residuals import PATIENCE
from foamcases.tries import RECIPE
from rom.provenance import code, commit, machine, versions
from rom.result import Result
from rom.scene import Scene, load_scene
from rom.setting import Setting
from rom.table import write_csv
from rom.validity import TURBULENT
from scripts.common import (
    AsJson,
    in_one_line,
    make_directory,
    messages,
    models,
    output,
    print_json,
    progress_bar,
    run_alone,
)
from scripts.executors import local
from scripts.pages import render
from scripts.runs import Failure, Job, store, stored
from scripts.stability_map import MEANING, Map, State, columns, in_words, spot_of
from scripts.sweep import Solved, expected_cost, run
from scripts.workplace import alone

RESOLUTION = 120
RUNS = "runs"


@dataclass(frozen=True, kw_only=True)
class Family:
    """A scene file, and the Reynolds numbers and depths (in film thicknesses) that it is varied to."""

    scene: Path
    reynolds_numbers: tuple[float, ...]
    depths_plus: tuple[float, ...]

    @property
    def places(self) -> tuple[tuple[float, float], ...]:
        """Every Reynolds number with every depth."""
        return tuple((number, depth) for number in self.reynolds_numbers for depth in self.depths_plus)

    def at(self, reynolds_number: float, depth_plus: float) -> Scene:
        """The scene at a place of the map."""
        film = load_scene(self.scene).geometry.film
        return load_scene(
            self.scene, [f"motion.reynolds_number={reynolds_number!r}", f"geometry.depth={depth_plus * film!r} m"]
        )


FAMILIES = {
    "pocket": Family(
        scene=Path(__file__).parent / "scenes" / "pocket.toml",
        reynolds_numbers=(40.0, 160.0, 500.0, 1000.0, 2000.0, 5000.0),
        depths_plus=(0.25, 0.5, 0.75, 1.25, 2.0, 3.0),
    )
}


@in_one_line
def command(
    family: Annotated[str, typer.Argument(metavar="FAMILY", help=f"A family of scenes: {', '.join(FAMILIES)}.")],
    out: Annotated[Path, typer.Option(help="Runs, tables and the page go here; finished runs are used again.")],
    resolution: Annotated[int, typer.Option(help="Mesh columns of the OpenFOAM models.")] = RESOLUTION,
    jobs: Annotated[int | None, typer.Option(help="Processes; by default one for each core.")] = None,
    as_json: AsJson = False,
) -> None:
    """Map where every model converges over Reynolds number and depth; write stability.csv, .json and report.html."""
    if family not in FAMILIES:
        raise InputError(f"FAMILY: got {family!r}; it must be one of {', '.join(FAMILIES)}")
    processes = len(os.sched_getaffinity(0)) if jobs is None else jobs
    if processes < 1:
        raise InputError(f"--jobs: got {jobs}; it must be 1 or more")
    make_directory(out)
    chosen, absent = FAMILIES[family], {m.name: m.available().detail for m in models() if not m.available().available}
    settings = _settings(resolution)
    with alone(out) as scratch:
        maps = _maps(chosen, settings, out / RUNS, processes, scratch)
        entries = _entries(family, resolution, maps, absent)
        write_csv(columns(maps), out / "stability.csv")
        with replacing(out / "stability.json") as path:
            path.write_text(json.dumps(entries, indent=1) + "\n", encoding="utf-8")
        render("stability.html.j2", out / "report.html", **_shown(chosen, entries, maps))
    if as_json:
        print_json(entries)
        return
    output.print(_table_of(maps))
    output.print(f"page: {escape(str(out / 'report.html'))}", soft_wrap=True)
    for name, reason in absent.items():
        messages.print(f"[yellow]left out:[/] {name}: {escape(reason)}", soft_wrap=True)


def _settings(resolution: int) -> list[Setting]:
    """Every available model with each of its schemes; those that write cases at the given resolution."""
    return [
        Setting(model=model, resolution=resolution if model.write else None, scheme=scheme)
        for model in models()
        if model.available().available
        for scheme in model.schemes or (None,)
    ]


def _maps(family: Family, settings: Sequence[Setting], place: Path, processes: int, scratch: Path) -> list[Map]:
    """Solve what is not on disk, store each answer as it comes, and put all of them together."""
    scenes = {at: family.at(*at) for at in family.places}
    jobs = {
        (setting.name, at): Job(
            scene=scene, setting=setting, path=place / f"Re{at[0]:g}-d{at[1]:g}" / f"{setting.name}.h5"
        )
        for setting in settings
        for at, scene in scenes.items()
    }
    answers: dict[Path, Result | Failure] = {}
    for job in jobs.values():
        fits = job.setting.model.applies(job.scene)
        refused = Failure(kind=InputError.__name__, message=fits.reason)
        if found := stored(job, with_fields=False) if fits.applies else refused:
            answers[job.path] = found
    missing = [job for job in jobs.values() if job.path not in answers]
    try:
        if missing:
            with progress_bar(sum(map(expected_cost, missing))) as advance, local(processes, scratch) as executor:
                advance(0.0, f"starting {len(missing)} runs")
                spent = 0.0
                for job, answer in run(missing, executor):
                    store(job, answer.file if isinstance(answer, Solved) else answer)
                    answers[job.path] = answer.result if isinstance(answer, Solved) else answer
                    spent += expected_cost(job)
                    advance(spent, f"{len(answers)} of {len(jobs)} runs")
    except (KeyboardInterrupt, SystemExit):
        messages.print(f"stopped at {len(answers)} of {len(jobs)} runs; the same command goes on", soft_wrap=True)
        raise
    return [
        Map(
            setting=setting,
            spots=tuple(spot_of(*at, answers[jobs[setting.name, at].path]) for at in family.places),
        )
        for setting in settings
    ]


def _entries(family: str, resolution: int, maps: Sequence[Map], absent: dict[str, str]) -> dict[str, Any]:
    return {
        "family": family,
        "resolution": resolution,
        "maps": [
            {
                "model": map_.setting.model.name,
                "scheme": map_.setting.scheme or "",
                "counts": {state.value: map_.count(state) for state in State},
                "cpu_s": map_.cpu_s,
                "in_words": in_words(map_, maps),
                "runs": [asdict(spot) for spot in map_.spots],
            }
            for map_ in maps
        ],
        "absent": absent,
        "provenance": {"machine": machine(), "code": code(), "commit": commit(), "versions": versions()},
    }


def _shown(family: Family, entries: dict[str, Any], maps: Sequence[Map]) -> dict[str, Any]:
    return {
        "entries": entries,
        "family": family,
        "scene": load_scene(family.scene),
        "maps": maps,
        "told": [in_words(map_, maps) for map_ in maps],
        "states": [(state, MEANING[state], sum(map_.count(state) for map_ in maps)) for state in State],
        "recipe": RECIPE,
        "patience": PATIENCE,
        "turbulent": TURBULENT,
    }


def _table_of(maps: Sequence[Map]) -> Table:
    states = [state for state in State if any(map_.count(state) for map_ in maps)]
    table = Table("model", "scheme", *(state.value for state in states), "CPU s")
    for map_ in maps:
        counts = (str(map_.count(state)) for state in states)
        table.add_row(map_.setting.model.name, map_.setting.scheme or "-", *counts, f"{map_.cpu_s:.3g}")
    return table


if __name__ == "__main__":
    run_alone(command)
