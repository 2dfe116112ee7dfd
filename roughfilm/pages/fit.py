"""The page of a fitted description."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.figures import fit as fit_figures
from roughfilm.fitting.run import Fit
from roughfilm.pages.render import render
from roughfilm.words.fit import HEADS, headline, rows


def write_page(fit: Fit, entries: Mapping[str, Any], path: Path) -> None:
    """Write the page; InputError if it cannot be written.

    Parameters
    ----------
    fit : the fit.
    entries : the object of ``--json``.
    path : the page.
    """
    render(
        "fit.html.j2",
        path,
        fit=fit,
        headline=headline(fit),
        heads=HEADS,
        rows=rows(fit),
        failing=[name for name, one in fit.held.items() if one.fails],
        maps=fit_figures.maps(fit),
        spectra=fit_figures.spectra(fit),
        bearing=fit_figures.bearing_curves(fit),
        quantities=fit_figures.quantities(fit),
        entries=entries,
    )
