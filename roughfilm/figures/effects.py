"""Figures of the effects of a bearing, switched on one after the other, and each switched off alone."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from roughfilm.figures.base import svg
from roughfilm.rom.bearing.effects.ablation import Amount
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.words.effects import Shown

MORE, LESS, WHOLE, BESIDE = "#2166ac", "#b2182b", "#5b6675", "#b07d2b"
STEP_HEIGHT = 0.34
"""Height of the bars of effects that are switched on, in rows."""

ALONE_HEIGHT = 0.18
"""Height of the bars of effects that are switched off alone, in rows."""


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A quantity of a study that is drawn, at a film or under a load in words, with changes that it does not count."""

    study: EffectStudy
    name: str
    how: Shown
    where: str
    beside: Mapping[str, Amount] = field(default_factory=dict)


def waterfall(panels: Sequence[Panel]) -> str:
    """A panel for each quantity, a row for each effect; the studies have the same effects."""
    names = [one.name for one in panels[0].study.contributions]
    beside = list(dict.fromkeys(effect for panel in panels for effect in panel.beside))
    rows = ["plain film", *names, "all effects", *(f"{effect}, not counted" for effect in beside)]
    figure = Figure(figsize=(10.4, 1.6 + 0.42 * len(rows)), layout="constrained")
    for axes, panel in zip(figure.subplots(1, len(panels), sharey=True, squeeze=False)[0], panels, strict=True):
        _panel(axes, panel.study, panel.name, panel.how, [panel.beside.get(effect) for effect in beside])
        axes.set_xlabel(f"{panel.how.title}, {panel.how.unit}")
        axes.set_title(panel.where, fontsize=9)
        axes.grid(visible=False, axis="y")
        axes.set_yticks(range(len(rows)), rows)
        axes.set_ylim(len(rows) - 0.4, -0.6)
    handles: list[Patch | Line2D] = [
        Patch(color=MORE, label="switched on next: increase"),
        Patch(color=LESS, label="switched on next: decrease"),
        Patch(facecolor="none", edgecolor="0.25", label="switched off alone"),
        Line2D([], [], color="0.25", linewidth=1, marker="|", label="uncertainty"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, fontsize=9)
    return svg(figure)


def _panel(axes: Axes, study: EffectStudy, name: str, how: Shown, beside: Sequence[Amount | None]) -> None:
    full = how.factor * study.full[name].value
    axes.axvline(full, color=WHOLE, linewidth=0.8, linestyle=":")
    if (plain := study.plain.get(name)) is not None:
        _bar(axes, 0, 0.0, how.factor * plain.value, how.factor * plain.uncertainty, WHOLE)
    else:
        axes.text(full, 0, "no solution", fontsize=8, color=WHOLE, ha="right", va="center")
    for row, one in enumerate(study.contributions, start=1):
        if (on := one.on.get(name)) is not None:
            end = how.factor * one.after[name].value
            step = how.factor * on.value
            _bar(axes, row - ALONE_HEIGHT / 2, end - step, end, how.factor * on.uncertainty, MORE if step > 0 else LESS)
        elif (after := one.after.get(name)) is not None:
            axes.plot(how.factor * after.value, row - ALONE_HEIGHT / 2, "o", color=MORE, markersize=4)
        if (alone := one.alone.get(name)) is not None:
            start, place = full - how.factor * alone.value, row + STEP_HEIGHT / 2
            axes.barh(place, full - start, ALONE_HEIGHT, left=start, facecolor="none", edgecolor="0.25", linewidth=0.9)
            axes.errorbar(start, place, xerr=how.factor * alone.uncertainty, color="0.25", linewidth=0.8, capsize=1.5)
    count = len(study.contributions) + 1
    _bar(axes, count, 0.0, full, how.factor * study.full[name].uncertainty, WHOLE)
    for row, added in enumerate(beside, start=count + 1):
        if added is not None:
            _bar(axes, row, full, full + how.factor * added.value, how.factor * added.uncertainty, BESIDE)


def _bar(axes: Axes, row: float, start: float, end: float, error: float, colour: str) -> None:
    axes.barh(row, end - start, STEP_HEIGHT, left=start, color=colour, alpha=0.85)
    axes.errorbar(end, row, xerr=error, color="0.25", linewidth=0.9, capsize=2)
