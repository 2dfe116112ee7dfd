"""Figures D.1 to D.7 of Paper D and E.4 of Paper E, and the claims of Paper D judged, on one page.

python -m scripts.studies.paper_d --out OUT. The measured profiles of the paper are not public: random ones with the
numbers of its Table D.1 stand for them. Source: Almqvist, Sahlin, Larsson and Glavatskih, Tribol. Int. 40 (2007) 574.
"""

from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.contact.synthetic.profile import STEEL_PROFILES
from roughfilm.pages.render import render, write_figures
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, progress_bar, run_alone
from scripts.studies.claims import Claim, tell, write_numbers
from scripts.studies.paper_d.claims import judge
from scripts.studies.paper_d.data import MACHINING, SPECTRA, Paper, compute
from scripts.studies.paper_e.surface import Reloading, load_model, reload


@in_one_line
def command(
    out: Annotated[Path, typer.Option(help="The page, every figure by its number, and the numbers go here.")],
    as_json: AsJson = False,
) -> None:
    """Press the profiles of Paper D and the model surface of Paper E, and judge the claims."""
    from roughfilm.figures.base import svg
    from scripts.studies.paper_d import figures as paper_d_figures  # matplotlib is slow to import

    make_directory(out)
    with progress_bar(5 * len(SPECTRA)) as advance:
        paper = compute(advance)
    model = load_model()
    again = [reload(contact) for contact in model]
    claims = judge(paper)
    figures = {name: draw(paper) for name, draw in paper_d_figures.NUMBERED.items()}
    plots = {name: svg(figure) for name, figure in (figures | {"E.4": paper_d_figures.e4(model)}).items()}
    write_figures(plots, out)
    told = numbers(paper, claims, model, again)
    write_numbers(told, out / "paper_d.json")
    captions = {name: str(draw.__doc__) for name, draw in paper_d_figures.NUMBERED.items()}
    captions["E.4"] = str(paper_d_figures.e4.__doc__)
    render(
        Path(__file__).parent / "page.html.j2",
        out / "paper_d.html",
        plots=plots,
        captions=captions,
        claims=claims,
        table=STEEL_PROFILES,
        machining=MACHINING,
        made=told["profiles"],
        seeds=len(next(iter(paper.profiles.values()))),
        model=list(zip(model, again, strict=True)),
    )
    tell(claims, told, out / "paper_d.html", as_json=as_json)


def numbers(paper: Paper, claims: list[Claim], model: list[Contact], again: list[Reloading]) -> dict[str, Any]:
    """What the page tells, as entries that JSON can hold: means and standard deviations over seeds."""

    def spread(state: dict[str, Any]) -> dict[str, Any]:
        return {
            name: {"mean": values.mean(axis=0).tolist(), "deviation": values.std(axis=0).tolist()}
            for name, values in state.items()
        }

    def made(spectrum: str, name: str) -> dict[str, float]:
        found = [height_statistics(heights) for heights in paper.profiles[spectrum, name]]
        return {
            key: sum(getattr(one, key) for one in found) / len(found)
            for key in ("average", "rms", "skewness", "kurtosis")
        }

    return {
        "claims": [asdict(claim) for claim in claims],
        "profiles": {spectrum: {name: made(spectrum, name) for name in STEEL_PROFILES} for spectrum in SPECTRA},
        "loads": list(paper.loads),
        "pressed": {
            spectrum: {name: spread(paper.pressed[spectrum, name]) for name in STEEL_PROFILES} for spectrum in SPECTRA
        },
        "finer": {
            spectrum: {name: spread(paper.finer[spectrum, name]) for name in STEEL_PROFILES} for spectrum in SPECTRA
        },
        "waves": list(paper.waves),
        "cut": {spectrum: spread(state) for spectrum, state in paper.cut.items()},
        "model_surface": [
            {
                "load": contact.load,
                "area_fraction": contact.area_fraction_pixel,
                "plasticity_index": contact.plasticity_index,
                "largest_plastic_displacement": float(contact.plastic_displacement.max()),
                "reloaded": asdict(reloading),
            }
            for contact, reloading in zip(model, again, strict=True)
        ],
    }


if __name__ == "__main__":
    run_alone(command)
