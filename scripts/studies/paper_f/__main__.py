"""Regenerate Figures F.5 to F.12 of Paper F for families of synthetic surfaces, fit its laws and judge its claims.

python -m scripts.studies.paper_f --out OUT. The ten elastomer surfaces of the paper are not public; measured ones of
other makers are added with --surfaces DIR (or ROUGHFILM_SURFACES). Finished surfaces are stored in OUT/found and used
by the next run. Source: F. Sahlin, Luleå 2008, Paper F.
"""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.rom.ladder.provenance import circumstances
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.paper_f import figures
from scripts.studies.paper_f import scatter as scattered
from scripts.studies.paper_f.claims import judge
from scripts.studies.paper_f.data import MODULUS, PARTS, Pressed, press_all
from scripts.studies.paper_f.fits import SLOPE, SealStudy, fit_groups, ratios
from scripts.studies.paper_f.sizes import COUNTS, grow
from scripts.studies.paper_f.surfaces import FAMILIES, HEIGHTS, POINTS, SEEDS, made_surfaces, measured_surfaces
from scripts.studies.study import Out, Surfaces, counted, publish


@in_one_line
def command(out: Out, surfaces: Surfaces = None, as_json: AsJson = False) -> None:
    """Press families of surfaces until they seal, fit sealing load and leakage, and judge the claims of Paper F."""
    make_directory(out)
    study = compute(out / "found", surfaces)
    results = numbers(study)
    publish(
        Path(__file__).parent,
        out,
        {name: draw(study) for name, draw in figures.DRAWINGS.items()},
        results,
        claims=judge(study),
        as_json=as_json,
        count=len(study.sample),
        laws=study.laws,
        slope=SLOPE,
        scatter=study.scatter,
        **{name: results[name] for name in ("families", "measured", "finer")},
    )


def compute(
    folder: Path | None = None,
    surfaces: Path | None = None,
    *,
    families: Sequence[str] = tuple(FAMILIES),
    seeds: Sequence[int] = SEEDS,
    points: int = POINTS,
    parts: Sequence[float] = PARTS,
    sizes: dict[int, int] | None = None,
    scatter: dict[str, int] | None = None,
) -> SealStudy:
    """Compute all data of the page; finished surfaces are stored in ``folder``; smaller sizes are for tests."""
    made = made_surfaces(families, seeds, points)
    finer = made_surfaces(families, seeds[:1], 2 * points)
    measured = measured_surfaces(surfaces, points)
    counts = COUNTS if sizes is None else sizes
    groups = scattered.COUNTS if scatter is None else scatter
    with counted(len(made) + 4 * len(finer) + len(measured) + len(counts) + len(groups)) as advance:
        found = press_all(made, folder, advance, parts)
        return SealStudy(
            sample=found,
            measured=press_all(measured, folder, advance, parts),
            finer=press_all(finer, folder and folder / "finer", partial(advance, steps=4), parts),
            sizes=grow(folder, advance, counts),
            scatter=scattered.scatter(folder, advance, groups),
            laws=fit_groups(found),
        )


def numbers(study: SealStudy) -> dict[str, Any]:
    """Return the numbers of the page in SI units."""
    families: dict[str, list[Pressed]] = {}
    for one in study.sample:
        families.setdefault(one.family, []).append(one)
    return {
        "modulus": MODULUS,
        "surfaces": [_surface(one) for one in study.sample],
        "families": {name: _family(members) for name, members in families.items()},
        "measured": [_surface(one) for one in study.measured],
        "finer": _finer(study),
        "sizes": [
            {"lengths": lengths, "area": area, "load": study.sizes.load[lengths]}
            for lengths, area in study.sizes.area.items()
        ],
        "scatter": {
            name: {"loads": one.loads, "mean": one.mean, "interval": one.interval}
            for name, one in study.scatter.items()
        },
        "laws": {name: {**vars(laws), "leakage": [*laws.leakage.values()]} for name, laws in study.laws.items()},
        "provenance": circumstances(),
    }


def _surface(one: Pressed) -> dict[str, Any]:
    return {
        "name": one.name,
        **{name: one.numbers.heights[name] for name in HEIGHTS},
        "slope": one.numbers.slope,
        "Sal": one.numbers.decay,
        "Str": one.numbers.aspect,
        "Ssk": one.numbers.skewness,
        "threshold": one.threshold,
        "sealed_area": one.sealed_area,
        "round_threshold": one.round_threshold,
        "round_area": one.round_area,
        "k": (one.threshold / MODULUS / one.numbers.heights["Spm"]),
        "load_over_slope": (one.threshold / MODULUS / one.numbers.slope),
        "loads": one.loads,
        "area": one.area,
        "direct": one.direct,
        "flow": one.flow,
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


def _finer(study: SealStudy) -> dict[str, float]:
    """Return the largest and the median change from ``sample`` to ``finer`` of W/(E* g′) and of the sealing area."""
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


if __name__ == "__main__":
    run_alone(command)
