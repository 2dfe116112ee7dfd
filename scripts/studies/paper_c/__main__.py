"""Regenerate Figures C.4 to C.13 of Paper C and judge its claims on flow factors of profiles.

python -m scripts.studies.paper_c --out OUT. The measured profiles of the paper are not public: random profiles with the
numbers of its Table C.2 replace them. Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1025.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.paper_c import data, figures
from scripts.studies.paper_c.claims import apart, judge, order_holds_to
from scripts.studies.paper_c.data import ALPHAS, RANGE, TABLE, WAYS, PaperC, compute
from scripts.studies.paper_c.films import LOADS
from scripts.studies.paper_d.data import MACHINING
from scripts.studies.study import Out, counted, publish


@in_one_line
def command(out: Out, as_json: AsJson = False) -> None:
    """Compute flow factors of profiles and films on them as Paper C does, and judge its claims."""
    make_directory(out)
    with counted(data.PARTS) as advance:
        paper = compute(advance)
    results = numbers(paper)
    publish(
        Path(__file__).parent,
        out,
        {name: draw(paper) for name, draw in figures.DRAWINGS.items()},
        results,
        claims=judge(paper),
        as_json=as_json,
        table=TABLE,
        machining=MACHINING,
        made=results["profiles"],
        seeds=len(next(iter(paper.profiles.values()))),
        peaks=paper.peaks,
        films=results["films"],
        spread=results["spread"],
        until=results["order_holds_to"],
        best=results["a_flows_best"],
    )


def numbers(paper: PaperC) -> dict[str, Any]:
    """Return the numbers of the page in SI units; differences are relative."""
    return {
        "profiles": {name: _mean_statistics(made) for name, made in paper.profiles.items()},
        "convergence": [
            {
                "profile": name,
                "alpha": alpha,
                "rule": str(rule),
                "left_out": left_out,
                "order": study.order(rule, left_out),
                "nodes": study.nodes,
                "errors": np.median(study.errors(rule, left_out), axis=0),
            }
            for (name, alpha), study in paper.convergence.items()
            for rule, left_out in study.found
        ],
        "alpha": RANGE,
        "factors": {name: values.mean(axis=0) for name, values in paper.factors.items()},
        "spread": {
            name: {
                str(alpha): {
                    "seeds": float(np.ptp(values[:, k, 0]) / values[:, k, 0].mean()),
                    "mean": float(values[:, k, 0].mean()),
                    "sums": float(paper.shuffled[name, WAYS[0]][0, k, 0]),
                }
                for alpha in ALPHAS
                for k in [int(np.argmin(np.abs(RANGE - alpha)))]
            }
            for name, values in paper.factors.items()
        },
        "a_flows_best": [
            {"seeds": int(best.any(axis=1).sum()), "from": float(RANGE[best.any(axis=0)].min(initial=1.0))}
            for best in (_a_flows_best(paper, factor) for factor in range(2))
        ],
        "rearranged": {name: {way: apart(paper.shuffled[name, way]).max(axis=0) for way in WAYS} for name in TABLE},
        "loads_by_nodes": [
            {"profile": name, "rule": str(rule), "left_out": left_out, "loads": values}
            for (name, rule, left_out), values in paper.loads.items()
        ],
        "films": {
            figure: {name: {"peak": float(film.pressure.max()), "load": film.load} for name, film in shown.items()}
            for figure, shown in paper.films.items()
        },
        "peaks": paper.peaks,
        "order_holds_to": order_holds_to(paper.curves),
        "min_film": {
            name: {"loads": LOADS, "clearance": np.mean([one.at(LOADS) for one in curves], axis=0)}
            for name, curves in paper.curves.items()
        },
        "ordered_by": {
            kind: {number: [ordering.concordance(number, k) for k in range(len(LOADS))] for number in ordering.numbers}
            for kind, ordering in paper.orderings.items()
        },
    }


def _a_flows_best(paper: PaperC, factor: int) -> NDArray[np.bool_]:
    """Return whether a factor of profile A exceeds those of all other profiles of the same seed, shape (seeds, α)."""
    others = [values[:, :, factor] for name, values in paper.factors.items() if name != "A"]
    return np.asarray(paper.factors["A"][:, :, factor] > np.max(others, axis=0))


def _mean_statistics(made: Sequence[Array]) -> dict[str, float]:
    found = [height_statistics(heights) for heights in made]
    names = ("peak", "average", "rms", "skewness", "kurtosis")
    return {name: float(np.mean([getattr(one, name) for one in found])) for name in names}


if __name__ == "__main__":
    run_alone(command)
