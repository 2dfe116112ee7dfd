"""Regenerate Figures D.1 to D.7 of Paper D and E.4 of Paper E, and judge the claims of Paper D.

python -m scripts.studies.paper_d --out OUT. The measured profiles of the paper are not public: random profiles with the
numbers of its Table D.1 replace them. Source: Almqvist, Sahlin, Larsson and Glavatskih, Tribol. Int. 40 (2007) 574.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.contact.synthetic.profile import STEEL_PROFILES
from roughfilm.terminal.console import AsJson, in_one_line, make_directory, run_alone
from scripts.studies.paper_d import figures
from scripts.studies.paper_d.claims import judge
from scripts.studies.paper_d.data import MACHINING, SPECTRA, PaperD, State, compute
from scripts.studies.paper_e.surface import Reloading, load_model, reload
from scripts.studies.study import Out, counted, publish


@in_one_line
def command(out: Out, as_json: AsJson = False) -> None:
    """Press the profiles of Paper D and the model surface of Paper E, and judge the claims."""
    make_directory(out)
    with counted(5 * len(SPECTRA)) as advance:
        paper = compute(advance)
    model = load_model()
    again = [reload(contact) for contact in model]
    results = numbers(paper, model, again)
    publish(
        Path(__file__).parent,
        out,
        {name: draw(paper) for name, draw in figures.DRAWINGS.items()} | {"E.4": figures.e4(model)},
        results,
        claims=judge(paper),
        as_json=as_json,
        table=STEEL_PROFILES,
        machining=MACHINING,
        made=results["profiles"],
        seeds=len(next(iter(paper.profiles.values()))),
        model=list(zip(model, again, strict=True)),
    )


def numbers(paper: PaperD, model: list[Contact], again: list[Reloading]) -> dict[str, Any]:
    """Return the numbers of the page, with means and standard deviations over seeds."""

    def spread(state: State) -> dict[str, Any]:
        return {name: {"mean": values.mean(axis=0), "deviation": values.std(axis=0)} for name, values in state.items()}

    def made(spectrum: str, name: str) -> dict[str, float]:
        found = [height_statistics(heights) for heights in paper.profiles[spectrum, name]]
        return {
            key: sum(getattr(one, key) for one in found) / len(found)
            for key in ("average", "rms", "skewness", "kurtosis")
        }

    def by_profile(values: Callable[[str, str], Any]) -> dict[str, dict[str, Any]]:
        return {spectrum: {name: values(spectrum, name) for name in STEEL_PROFILES} for spectrum in SPECTRA}

    return {
        "profiles": by_profile(made),
        "loads": paper.loads,
        "pressed": by_profile(lambda *key: spread(paper.pressed[key])),
        "finer": by_profile(lambda *key: spread(paper.finer[key])),
        "waves": paper.waves,
        "cut": {spectrum: spread(state) for spectrum, state in paper.cut.items()},
        "model_surface": [
            {
                "load": contact.load,
                "area_fraction": contact.area_fraction_pixel,
                "plasticity_index": contact.plasticity_index,
                "largest_plastic_displacement": float(contact.plastic_displacement.max()),
                "reloaded": reloading,
            }
            for contact, reloading in zip(model, again, strict=True)
        ],
    }


if __name__ == "__main__":
    run_alone(command)
