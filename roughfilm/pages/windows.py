"""The page of many windows of a surface."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.contact.windows.scatter import MIN_INDEPENDENT
from roughfilm.figures import windows as window_figures
from roughfilm.pages.render import render
from roughfilm.sampling.answer import Answer
from roughfilm.sampling.plan import Plan
from roughfilm.words.windows import headline, known_to, quantity_cells, scale_of_quantity, title_of

DRAWN = {
    "": ("Sq", "Ssk", "Sal", "A11"),
    "dry_contact": ("area_fraction", "mean_gap", "mean_contact_pressure", "rms_height"),
    "seal": ("leakage_per_width", "area_fraction", "mean_gap", "sealing_load"),
    "bearing": ("friction_coefficient", "separation", "contact_share", "rms_height"),
}
"""The quantities that are drawn, by the kind of scene; "" without one."""

MOST_DRAWN = 4
"""Largest number of quantities that are drawn."""


def write_page(
    plan: Plan, answer: Answer, kind: str, entries: Mapping[str, Any], heads: Sequence[str], path: Path
) -> None:
    """Write the page; InputError if the file cannot be written.

    Parameters
    ----------
    plan : the windows.
    answer : their scatter, trend and warnings.
    kind : kind of the scene; "" without one.
    entries : the object of ``--json``.
    heads : heads of the table of quantities.
    path : the page.
    """
    varied = [name for name, one in answer.quantities.items() if one.scatter.deviation > 0]
    wanted = [name for name in DRAWN[kind] if name in varied]
    chosen = list(dict.fromkeys([answer.headline, *wanted, *varied]))[:MOST_DRAWN]
    shown = {
        name: (title_of(name, kind), answer.quantities[name], scale_of_quantity(name, answer.quantities[name]))
        for name in chosen
    }
    one = answer.quantities[answer.headline]
    scale = scale_of_quantity(answer.headline, one)
    render(
        "windows.html.j2",
        path,
        answer=answer,
        headline=headline(answer, kind),
        title=title_of(answer.headline, kind),
        one=one,
        scale=scale,
        kind=kind,
        entries=entries,
        warnings=answer.warnings,
        least=MIN_INDEPENDENT,
        known=None if one.scatter.relative is None else known_to(one.scatter, scale),
        places=window_figures.places(plan.surface, plan.groups) if plan.surface is not None else None,
        seeds=window_figures.seeds(plan.groups[0]) if plan.surface is None else None,
        values=window_figures.values(shown),
        sizes=window_figures.over_size(shown) if len(plan.groups) > 1 else None,
        numbers=window_figures.over_number(shown) if answer.count > 1 else None,
        heads=heads,
        rows=[quantity_cells(name, quantity, kind) for name, quantity in answer.quantities.items()],
        groups=[(group.size, len(group.cells), group.independent) for group in plan.groups],
        decay=plan.decay,
    )
