"""Figures C.4 to C.13 of Paper C, and its claims on flow factors of profiles judged, on one page.

python -m scripts.studies.paper_c --out OUT. The measured profiles of the paper are not public: random ones with the
numbers of its Table C.2 stand for them. Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1025.
"""

from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.pages.render import render, write_figures
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from scripts.studies.claims import Claim, tell, write_numbers
from scripts.studies.paper_c.claims import apart, judge, order_holds_to
from scripts.studies.paper_c.data import ALPHAS, PARTS, RANGE, TABLE, WAYS, Paper, compute
from scripts.studies.paper_c.films import LOADS, MODULI
from scripts.studies.paper_d.data import MACHINING

OPEN = (
    (
        "the measured profiles",
        "random ones, self-affine (H = 0.8 from the 4th wave on), 512 points on 0.42 mm",
        "not public; all five numbers of each row of Table C.2 are met, see above",
    ),
    (
        "rmax",
        "height of the highest point over the mean",
        "Eq. C.12 has contact at α = 1 and a mean of G of 1, so that it cannot be the whole height",
    ),
    (
        "which factor is which",
        "φx of pressure, φs of sliding",
        "Eqs. C.14 to C.18; the nomenclature has them exchanged",
    ),
    (
        "β, printed 10⁹ GPa",
        "1 GPa",
        "10 GPa would take S of C.10 and C of C.12 beyond the axes of the paper, 100 and 140 MPa, see below",
    ),
    (
        "where the nodes lie on the profile",
        "on its points (N = 2ᵏ), and beside them (N = 2ᵏ − 4)",
        "not told; it decides the order of Simpson's rule",
    ),
    (
        "the joint of the period",
        "a straight line from the last point to the first",
        "512 lines; the paper may have 511",
    ),
    (
        "rearrangements",
        "six, cut at random levels (roughfilm.contact.synthetic.rearrangement)",
        "the paper has five, built peak by peak, of a profile with 2¹⁶ points",
    ),
    (
        "flow factors between computed α (C.10 to C.12)",
        "none are: closed forms at every place",
        "the paper uses splines",
    ),
    ("films of C.13", "narrowing by 1 µm from inlet to outlet", "the caption's max h0 = min h0 + 1 µm"),
)
"""What the paper leaves open, what is taken, and why."""


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, every figure by its number, and the numbers go here.")],
    as_json: AsJson = False,
) -> None:
    """Compute flow factors of profiles and films on them as Paper C does, and judge its claims."""
    from roughfilm.figures.base import svg
    from scripts.studies.paper_c import figures as paper_c_figures  # matplotlib is slow to import

    make_directory(out)
    with progress_bar(PARTS) as advance:
        paper = compute(advance)
    claims = judge(paper)
    drawings = paper_c_figures.NUMBERED | {"claim 14": paper_c_figures.claim_14}
    plots = {name: svg(draw(paper)) for name, draw in drawings.items()}
    write_figures({name.replace(" ", "_"): text for name, text in plots.items()}, out)
    told = numbers(paper, claims)
    write_numbers(told, out / "paper_c.json")
    render(
        Path(__file__).parent / "page.html.j2",
        out / "paper_c.html",
        plots=plots,
        captions={name: str(draw.__doc__) for name, draw in drawings.items()},
        claims=claims,
        table=TABLE,
        machining=MACHINING,
        made=told["profiles"],
        seeds=len(next(iter(paper.profiles.values()))),
        peaks=paper.peaks,
        films=told["films"],
        spread=told["spread"],
        until=told["order_holds_to"],
        best=told["a_flows_best"],
        open=OPEN,
    )
    tell(claims, told, out / "paper_c.html", as_json=as_json)


def numbers(paper: Paper, claims: list[Claim]) -> dict[str, Any]:
    """What the page tells, as entries that JSON can hold: SI units, differences as parts of one."""
    return {
        "claims": [asdict(claim) for claim in claims],
        "profiles": {name: _achieved(made) for name, made in paper.profiles.items()},
        "convergence": [
            {
                "profile": name,
                "alpha": alpha,
                "rule": str(rule),
                "left_out": left_out,
                "order": study.order(rule, left_out),
                "nodes": study.nodes.tolist(),
                "errors": np.median(study.errors(rule, left_out), axis=0).tolist(),
            }
            for (name, alpha), study in paper.convergence.items()
            for rule, left_out in study.found
        ],
        "alpha": RANGE.tolist(),
        "factors": {name: values.mean(axis=0).tolist() for name, values in paper.factors.items()},
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
            for i in range(2)
            for best in [_best(paper, "A", i)]
        ],
        "rearranged": {
            name: {way: apart(paper.shuffled[name, way]).max(axis=0).tolist() for way in WAYS} for name in TABLE
        },
        "loads_by_nodes": [
            {"profile": name, "rule": str(rule), "left_out": left_out, "loads": values.tolist()}
            for (name, rule, left_out), values in paper.loads.items()
        ],
        "films": {
            figure: {name: {"peak": float(film.pressure.max()), "load": film.load} for name, film in shown.items()}
            for figure, shown in paper.films.items()
        },
        "peaks": {str(modulus): paper.peaks[modulus] for modulus in MODULI},
        "order_holds_to": order_holds_to(paper.curves),
        "min_film": {
            name: {
                "loads": LOADS,
                "clearance": np.mean([one.at(LOADS) for one in curves], axis=0).tolist(),
            }
            for name, curves in paper.curves.items()
        },
        "ordered_by": {
            kind: {number: [ordering.concordance(number, k) for k in range(len(LOADS))] for number in ordering.numbers}
            for kind, ordering in paper.orderings.items()
        },
    }


def _best(paper: Paper, name: str, factor: int) -> NDArray[np.bool_]:
    """Where a profile lets more through than all others of the same seed, shape (seeds, α)."""
    others = [values[:, :, factor] for other, values in paper.factors.items() if other != name]
    return np.asarray(paper.factors[name][:, :, factor] > np.max(others, axis=0))


def _achieved(made: list[Any]) -> dict[str, float]:
    found = [height_statistics(heights) for heights in made]
    names = ("peak", "average", "rms", "skewness", "kurtosis")
    return {name: float(np.mean([getattr(one, name) for one in found])) for name in names}


if __name__ == "__main__":
    run_alone(command)
