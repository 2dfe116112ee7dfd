"""The page of two combined surfaces."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.contact.registration.combine import Combined
from roughfilm.figures import combination as combination_figures
from roughfilm.pages.render import render
from roughfilm.words.combination import answer, combination_rows, combination_steps


def write_page(combined: Combined, names: tuple[str, str], provenance: Mapping[str, Any], path: Path) -> None:
    """Write the page; InputError if the file cannot be written."""
    titles = (f"first: {names[0]}", f"second, on the first: {names[1]}")
    if combined.operation == "difference":
        titles = (f"before: {names[0]}", f"after, on the grid of before: {names[1]}")
    render(
        "combination.html.j2",
        path,
        names=names,
        combined=combined,
        answer=answer(combined, names),
        rows=combination_rows(combined),
        steps=[line.partition(": ") for line in combination_steps(combined)],
        maps=combination_figures.surface_maps(combined, titles),
        result=combination_figures.result_map(combined),
        profiles=combination_figures.profiles(combined, names),
        provenance=provenance,
    )
