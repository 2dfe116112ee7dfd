"""roughfilm compare: every model that applies on one scene, in one report."""

import json
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from contact.errors import ConvergenceError, InputError
from contact.files import replacing
from rom.comparison import COMPARED, Point, effects, points, scale, to_best
from rom.ladder import Model, best
from rom.provenance import code, versions
from rom.result import Result
from rom.scene import Scene, load_scene, scene_entries
from rom.store import as_entries, load, save
from scripts.common import (
    NOT_CONVERGED,
    AsJson,
    Overrides,
    ScenePath,
    in_one_line,
    make_directory,
    messages,
    models,
    output,
    print_json,
    progress_bar,
)
from scripts.rendering import draw_apart
from scripts.report import Picture, Report, cheapest_within, write_report
from scripts.solve import table_of

QUICK_S = 0.1
"""Models that cost less are timed as the fastest of ``REPEATS`` runs, so that start-up does not hide them."""

REPEATS = 7

SAFETY = 3.0
"""The usual factor of the grid convergence index where only two grids are compared."""

Advance = Callable[[float, str], None]


@dataclass(frozen=True, kw_only=True)
class Job:
    """One model at one resolution, and the file that keeps its result."""

    model: Model
    resolution: int
    path: Path


@in_one_line
def command(
    scene: ScenePath,
    out: Annotated[Path, typer.Option(help="Report, results and figures go here; finished results are used again.")],
    set_: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """Run every model that applies and write report.html, results (.h5) and figures."""
    read = load_scene(scene, set_ or ())
    make_directory(out)
    absent: dict[str, str] = {}
    jobs: list[Job] = []
    for model in models():
        reason = _reason_to_leave_out(model, read)
        if reason:
            absent[model.name] = reason
            continue
        order = dict.fromkeys((model.resolution, *model.resolutions))
        jobs += [Job(model=model, resolution=n, path=out / "results" / f"{model.name}-{n}.h5") for n in order]

    runs = _run_all(read, jobs, absent)
    results = {
        model.name: runs[(model.name, model.resolution)] for model in models() if (model.name, model.resolution) in runs
    }
    if not results:
        raise ConvergenceError("no model solved the scene: " + "; ".join(f"{k}: {v}" for k, v in absent.items()))
    report, entries = _judge(read, results, list(runs.values()), absent, out)
    write_report(report, out / "report.html")

    if as_json:
        print_json(entries)
    else:
        for result in results.values():
            output.print(table_of(result))
        output.print(f"report: {out / 'report.html'}", soft_wrap=True)
    for name, reason in absent.items():
        messages.print(f"[yellow]left out:[/] {name}: {reason}", soft_wrap=True)
    if any(model.name in absent and _reason_to_leave_out(model, read) is None for model in models()):
        raise typer.Exit(NOT_CONVERGED)


def _reason_to_leave_out(model: Model, scene: Scene) -> str | None:
    fits, found = model.applies(scene), model.available()
    if not fits.applies:
        return fits.reason
    return None if found.available else found.detail


def _run_all(scene: Scene, jobs: list[Job], absent: dict[str, str]) -> dict[tuple[str, int], Result]:
    """Solve what is not solved already; a model that fails at its own resolution is put among the absent."""
    runs: dict[tuple[str, int], Result] = {}
    costs = [job.model.cost(scene, job.resolution) for job in jobs]
    with progress_bar(sum(costs)) as advance:
        spent = 0.0
        for job, expected in zip(jobs, costs, strict=True):
            words = f"{job.model.name} at {job.resolution}"
            base = spent

            def step(
                done: float, detail: str, base: float = base, expected: float = expected, words: str = words
            ) -> None:
                advance(base + done * expected, f"{words}: {detail}")

            step(0.0, "starting")
            try:
                runs[(job.model.name, job.resolution)] = _solved_once(scene, job, step)
            except ConvergenceError as error:
                if job.resolution == job.model.resolution:
                    absent[job.model.name] = str(error)
                else:
                    messages.print(f"[yellow]not on the chart:[/] {words}: {error}", soft_wrap=True)
            spent += expected
    return runs


def _solved_once(scene: Scene, job: Job, step: Advance) -> Result:
    """The stored result if it was computed from the same scene by the same code; else a new one, stored."""
    if job.path.exists():
        try:
            stored = load(job.path)
            if _same(stored, scene, job):
                return stored
        except InputError:
            pass  # an unreadable file is computed again and replaced
    repeats = REPEATS if job.model.cost(scene, job.resolution) < QUICK_S else 1
    tries = [job.model.solve(scene, resolution=job.resolution, progress=step) for _ in range(repeats)]
    result = min(tries, key=lambda one: one.numerics.cpu_s)
    save(result, job.path)
    return result


def _same(stored: Result, scene: Scene, job: Job) -> bool:
    origin = stored.provenance
    return (
        (stored.model, stored.numerics.resolution) == (job.model.name, job.resolution)
        and (origin.get("scene"), origin.get("code")) == (scene_entries(scene), code())
        and origin.get("versions") == versions()
        and origin.get("openfoam") in (None, job.model.available().detail)
    )


def _judge(
    scene: Scene, results: dict[str, Result], runs: list[Result], absent: dict[str, str], out: Path
) -> tuple[Report, dict[str, Any]]:
    ladder = models()
    top = best([model for model in ladder if model.name in results])
    reference = results[top.name]
    chart = points(reference, runs)
    floor = _uncertainty(reference, runs)
    from scripts.figures import pressure, speed_against_accuracy  # matplotlib is slow to import

    plots = {"pressure": pressure(scene, results), "chart": speed_against_accuracy(chart, floor)}
    for name, svg in plots.items():
        with replacing(out / f"{name}.svg") as scratch:
            scratch.write_text('<?xml version="1.0" encoding="utf-8"?>\n' + svg, encoding="utf-8")
    with replacing(out / "chart.json") as scratch:
        scratch.write_text(json.dumps(_raw(chart, reference, floor), indent=1) + "\n", encoding="utf-8")
    report = Report(
        scene=scene,
        models=ladder,
        results=results,
        absent=absent,
        best=top.name,
        to_best=to_best(ladder, results),
        effects=effects(ladder, results),
        chart=chart,
        uncertainty=floor,
        plots=plots,
        pictures=_pictures(results, out),
    )
    entries = {
        **as_entries(reference),
        "models": [as_entries(result) for result in results.values()],
        "differences": [asdict(difference) for difference in report.to_best + report.effects],
        "cheapest_within_10_percent": cheapest_within(report, 0.10),
        "chart": _raw(chart, reference, floor),
        "absent": absent,
        "report": str(out / "report.html"),
    }
    return report, entries


def _uncertainty(reference: Result, runs: list[Result]) -> dict[str, float]:
    """Relative numerical uncertainty of the reference: its grid convergence index, for order two.

    SAFETY |f - f_coarser| / (r² - 1) for the next coarser grid, r times as coarse; Roache 1994, doi:10.1115/1.2910291.
    """
    coarser = [
        run for run in runs if run.model == reference.model and run.numerics.resolution < reference.numerics.resolution
    ]
    if not coarser:
        return {}
    near = max(coarser, key=lambda run: run.numerics.resolution)
    ratio = reference.numerics.resolution / near.numerics.resolution
    return {
        quantity: SAFETY
        * abs(reference.quantities[quantity].value - near.quantities[quantity].value)
        / (ratio**2 - 1)
        / scale(reference, quantity)
        for quantity in COMPARED
    }


def _raw(chart: tuple[Point, ...], reference: Result, floor: dict[str, float]) -> dict[str, Any]:
    return {
        "reference": {
            "model": reference.model,
            "resolution": reference.numerics.resolution,
            "cpu_s": reference.numerics.cpu_s,
            "uncertainty": floor,
        },
        "points": [asdict(point) for point in chart],
        "machine": {**reference.provenance["machine"], "load_average": reference.provenance["load_average"]},
    }


def _pictures(results: dict[str, Result], out: Path) -> tuple[Picture, ...]:
    def picture(name: str) -> Picture:
        path = out / f"flow-{name}.png"
        drawn = draw_apart(out / "results" / f"{name}-{results[name].numerics.resolution}.h5", path)
        return Picture(model=name, path=path if drawn.available else None, reason=drawn.detail)

    resolved = [name for name, result in results.items() if "vertices" in result.fields]
    with ThreadPoolExecutor() as pool:
        return tuple(pool.map(picture, reversed(resolved)))


if __name__ == "__main__":
    typer.run(command)
