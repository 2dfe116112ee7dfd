"""Figures of the study: the fraction of held-out windows within the intervals, by surface and quantity."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from roughfilm.contact.windows.scatter import binomial_interval
from roughfilm.figures.base import new_figure
from roughfilm.fitting.quantities import NAMES
from scripts.studies.windows.data import Coverage

COLOURS = {"random": "#2166ac", "spatial": "#e08214"}


def coverage(found: Sequence[Coverage], area: float) -> Figure:
    """Return the fractions inside at one contact area, with 95 % intervals of Clopper and Pearson."""
    names = list(dict.fromkeys(one.surface for one in found))
    figure, panels = new_figure((11, 1.2 + 0.34 * len(names)), 1, len(NAMES), sharey=True)
    for axes, quantity in zip(panels, NAMES, strict=True):
        axes.axvspan(90, 98, color="0.9", zorder=-2)
        for one in found:
            if one.quantity != quantity or one.area != area:
                continue
            low, high = binomial_interval(one.fraction, one.count)
            row = names.index(one.surface) + (0.15 if one.halves == "spatial" else -0.15)
            axes.plot([100 * low, 100 * high], [row, row], color=COLOURS[one.halves], linewidth=1.2)
            label = f"{one.halves} halves" if one.surface == names[0] else None
            axes.plot(100 * one.fraction, row, "o", color=COLOURS[one.halves], markersize=5, label=label)
        axes.set(xlabel=f"{quantity}, %", xlim=(40, 101))
        axes.set_yticks(range(len(names)), names)
        axes.set_ylim(len(names) - 0.5, -0.5)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return figure
