"""Figures F.5 to F.12 of Paper F over made families of surfaces, its laws fitted again, its claims judged, on a page.

python -m scripts.studies.paper_f --out OUT. The ten elastomer surfaces of the paper are not public; measured ones of
other
makers stand beside the made ones with --surfaces DIR (or ROUGHFILM_SURFACES). Every surface is kept in OUT/found: what
was finished is not done again. Source: F. Sahlin, Luleå 2008, Paper F.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from roughfilm.pages.render import render, write_figures
from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from scripts.studies.study import Claim, Surfaces, tell, write_numbers
from scripts.studies.paper_f import sizes as paper_f_sizes
from scripts.studies.paper_f.claims import judge
from scripts.studies.paper_f.data import MODULUS, PARTS, Pressed, press_all
from scripts.studies.paper_f.fits import SLOPE, ratios
from scripts.studies.paper_f.study import Laws, Study, fit_groups
from scripts.studies.paper_f.surfaces import FAMILIES, HEIGHTS, POINTS, SEEDS, made_surfaces, measured_surfaces


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, its figures, the numbers, and every finished surface go here.")],
    surfaces: Surfaces = None,
    as_json: AsJson = False,
) -> None:
    """Press families of surfaces until they are sealed, fit sealing load and leakage, and judge Paper F."""
    from roughfilm.figures.base import svg
    from scripts.studies.paper_f import figures as paper_f_figures  # matplotlib is slow to import

    make_directory(out)
    study = compute(out / "found", surfaces)
    claims = judge(study)
    plots = {name: svg(draw(study)) for name, draw in paper_f_figures.NUMBERED.items()}
    write_figures({name.replace(" ", "_"): text for name, text in plots.items()}, out)
    told = numbers(study, claims)
    write_numbers(told, out / "paper_f.json")
    render(
        Path(__file__).parent / "page.html.j2",
        out / "paper_f.html",
        plots=plots,
        captions={name: str(draw.__doc__) for name, draw in paper_f_figures.NUMBERED.items()},
        claims=claims,
        count=len(study.sample),
        laws=study.laws,
        slope=SLOPE,
        families=told["families"],
        measured=told["measured"],
        finer=told["finer"],
    )
    tell(claims, told, out / "paper_f.html", as_json=as_json)


def compute(
    folder: Path | None = None,
    surfaces: Path | None = None,
    *,
    families: Sequence[str] = tuple(FAMILIES),
    seeds: Sequence[int] = SEEDS,
    points: int = POINTS,
    parts: Sequence[float] = PARTS,
    sizes: dict[int, int] | None = None,
) -> Study:
    """Everything that the page shows, kept in a folder; by default as the page has it, smaller for a test."""
    made = made_surfaces(families, seeds, points)
    finer = made_surfaces(families, seeds[:1], 2 * points)
    measured = measured_surfaces(surfaces, points)
    counts = paper_f_sizes.COUNTS if sizes is None else sizes
    with progress_bar(len(made) + 4 * len(finer) + len(measured) + len(counts)) as bar:
        advance = _counted(bar)
        found = press_all(made, folder, advance, parts)
        beside = press_all(measured, folder, advance, parts)
        twice = press_all(finer, None if folder is None else folder / "finer", _by(advance, 4), parts)
        grown = paper_f_sizes.grow(folder, advance, counts)
        return Study(sample=found, finer=twice, measured=beside, sizes=grown, laws=fit_groups(found))


def _counted(bar: Callable[[float, str], None]) -> Callable[[str], None]:
    done = -1

    def advance(words: str) -> None:
        nonlocal done
        done += 1
        bar(done, words)

    return advance


def _by(advance: Callable[[str], None], times: int) -> Callable[[str], None]:
    def several(words: str) -> None:
        for _ in range(times):
            advance(words)

    return several


def numbers(study: Study, claims: Sequence[Claim]) -> dict[str, Any]:
    """What the page tells, as entries that JSON can hold, SI units."""
    families: dict[str, list[Pressed]] = {}
    for one in study.sample:
        families.setdefault(one.family, []).append(one)
    told: dict[str, Any] = {
        "claims": [asdict(claim) for claim in claims],
        "modulus": MODULUS,
        "surfaces": [_told(one) for one in study.sample],
        "families": {name: _family(members) for name, members in families.items()},
        "measured": [_told(one) for one in study.measured],
        "finer": _finer(study),
        "sizes": [
            {"lengths": lengths, "area": area.tolist(), "load": study.sizes.load[lengths].tolist()}
            for lengths, area in study.sizes.area.items()
        ],
        "laws": {name: _laws(laws) for name, laws in study.laws.items()},
        "provenance": circumstances(),
    }
    return {name: _plain(value) for name, value in told.items()}


def _plain(value: Any) -> Any:
    """Null for what is no number."""
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _told(one: Pressed) -> dict[str, Any]:
    return {
        "name": one.name,
        **{name: one.numbers.heights[name] for name in HEIGHTS},
        "slope": one.numbers.slope,
        "Sal": one.numbers.decay,
        "Str": one.numbers.aspect,
        "Ssk": one.numbers.skewness,
        "threshold": one.threshold.tolist(),
        "sealed_area": one.sealed_area.tolist(),
        "round_threshold": one.round_threshold.tolist(),
        "round_area": one.round_area.tolist(),
        "k": (one.threshold / MODULUS / one.numbers.heights["Spm"]).tolist(),
        "load_over_slope": (one.threshold / MODULUS / one.numbers.slope).tolist(),
        "loads": one.loads.tolist(),
        "area": one.area.tolist(),
        "direct": one.direct.tolist(),
        "flow": one.flow.tolist(),
    }


def _family(members: Sequence[Pressed]) -> dict[str, Any]:
    k, c = ratios(members, "Spm"), ratios(members, SLOPE)
    area = np.array([one.sealed_area for one in members])
    return {
        "count": len(members),
        "length": float(np.mean([one.numbers.heights["Sq"] / one.numbers.slope for one in members])),
        "skewness": float(np.mean([one.numbers.skewness for one in members])),
        "peaks_over_valleys": float(
            np.mean([one.numbers.heights["Spm"] / one.numbers.heights["Svm"] for one in members])
        ),
        "area": [float(area.min()), float(area.mean()), float(area.max())],
        "across": area.mean(axis=0).tolist(),
        "k": float(np.exp(np.log(k).mean())),
        "k_spread": float(np.exp(np.log(k).std())),
        "c": float(np.exp(np.log(c).mean())),
        "c_spread": float(np.exp(np.log(c).std())),
    }


def _finer(study: Study) -> dict[str, float]:
    """The largest and the middle change from ``sample`` to ``finer``, of W/(E* g′) and of the area at the threshold."""
    coarse = {one.name: one for one in study.sample}
    pairs = [(coarse[one.name], one) for one in study.finer]
    load = np.abs([b.threshold / b.numbers.slope / (a.threshold / a.numbers.slope) - 1 for a, b in pairs])
    area = np.abs([b.sealed_area - a.sealed_area for a, b in pairs])
    return {
        "load_middle": float(np.median(load)),
        "load_largest": float(load.max()),
        "area_middle": float(np.median(area)),
        "area_largest": float(area.max()),
    }


def _laws(laws: Laws) -> dict[str, Any]:
    told = asdict(laws)
    told["leakage"] = [asdict(one) for one in laws.leakage.values()]
    return told


if __name__ == "__main__":
    run_alone(command)
