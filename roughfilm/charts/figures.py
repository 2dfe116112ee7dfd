"""Figures of error against CPU time: one for each family, and one of all families."""

import math
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.charts.judgement import Chart
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import PICTURE
from roughfilm.figures.base import FRONT, svg
from roughfilm.figures.view import Style
from roughfilm.rom.studies.comparison import Point

MIN_LABEL_DISTANCE = 0.12
"""Least distance of two labelled points, decades."""

LABEL_OFFSETS = ((5, 4), (5, -10), (-14, 4), (-14, -10))
"""Offsets of the labels from their points, pt; the solvers take them in turn."""

MIN_DRAWN_ERROR = 1e-8
"""Smallest relative error that is drawn."""

PEERS = (
    Style(colour="#d6604d", marker="*"),
    Style(colour="#8c6bb1", marker="X"),
    Style(colour="#1b7837", marker="P"),
)
"""Styles of the peers, in their order."""


def chart_figure(chart: Chart) -> str:
    """The figure of one chart, with a legend beside it, as SVG text."""
    figure = Figure(figsize=(10, 5), layout="constrained")
    axes = figure.subplots()
    _draw(axes, chart, size=7, numbers=True)
    family = chart.family
    axes.set_xlabel("CPU time, s")
    axes.set_ylabel(f"error in {family.quantity}, %")
    title = f"numbers: {family.resolution_meaning}"
    figure.legend(loc="outside right upper", fontsize=9, title="\n".join(textwrap.wrap(title, 30)), alignment="left")
    return svg(figure)


def overview(charts: Sequence[Chart], path: Path) -> None:
    """Draw small figures of all charts into one PNG file; InputError if it cannot be written."""
    columns = min(len(charts), 3)
    rows = -(-len(charts) // columns)
    figure = Figure(figsize=(4.6 * columns, 4.4 * rows), layout="constrained")
    for part, chart in zip(figure.subfigures(rows, columns, squeeze=False).ravel(), charts, strict=False):
        axes = part.subplots()
        _draw(axes, chart, size=5, numbers=False)
        axes.set_title(chart.family.name, fontsize=12)
        axes.set_xlabel("CPU time, s", fontsize=9)
        axes.set_ylabel(f"error in {chart.family.quantity}, %", fontsize=9)
        axes.tick_params(labelsize=8)
        part.legend(loc="outside lower center", fontsize=7, ncols=3, columnspacing=1.0, handletextpad=0.4)
    with replacing(path, PICTURE) as scratch:
        figure.savefig(scratch, format="png", dpi=130, metadata={"Software": None})


def _draw(axes: Axes, chart: Chart, *, size: float, numbers: bool) -> None:
    styles = _styles(chart)
    for number, solver in enumerate(chart.solvers):
        own = [point for point in chart.points if point.model == solver]
        style, peer = styles[solver], solver in chart.peers
        times, errors = [point.cpu_s for point in own], [_drawn(chart, point) for point in own]
        axes.plot(
            times,
            errors,
            style.marker,
            linestyle="--" if peer else "-",
            linewidth=0.8,
            color=style.colour,
            markersize=size * (1.35 if peer else 1.0),
            markerfacecolor="none" if peer else style.colour,
            alpha=0.85,
            label=f"{solver} (other program)" if peer else solver,
        )
        if (bar := 100 * chart.truth.uncertainty) >= 100 * MIN_DRAWN_ERROR:
            ends = [max(error - bar, 100 * MIN_DRAWN_ERROR) for error in errors], [error + bar for error in errors]
            axes.vlines(times, *ends, color=style.colour, alpha=0.3, linewidth=1)
        if numbers:
            texts = [f"{point.resolution}" for point in own]
            _number(
                axes,
                list(zip(texts, times, errors, strict=True)),
                LABEL_OFFSETS[number % len(LABEL_OFFSETS)],
                style.colour,
            )
    drawn = {(point.model, point.resolution): point for point in chart.points}
    axes.plot(
        [point.cpu_s for point in chart.front],
        [_drawn(chart, drawn[point.model, point.resolution]) for point in chart.front],
        color="black",
        linewidth=1.2,
        label=FRONT,
        zorder=0,
    )
    axes.set_xscale("log")
    axes.set_yscale("log")
    known = 100 * chart.truth.uncertainty
    low, high = axes.get_ylim()
    if known > low:
        axes.axhspan(low, known, color="black", alpha=0.07, linewidth=0, label="uncertainty of the reference")
        axes.set_ylim(low, high)


def _number(
    axes: Axes, points: Sequence[tuple[str, float, float]], beside: tuple[int, int], colour: str | None
) -> None:
    """Write the resolutions beside the points of one solver, unless they would overlap."""
    last = (0.0, 0.0)
    for text, time, error in points:
        place = (math.log10(time), math.log10(error))
        if math.dist(place, last) > MIN_LABEL_DISTANCE:
            axes.annotate(text, (time, error), beside, textcoords="offset points", size=7, color=colour)
            last = place


def _drawn(chart: Chart, point: Point) -> float:
    return 100 * max(chart.error(point), MIN_DRAWN_ERROR)


def _styles(chart: Chart) -> Mapping[str, Style]:
    own = {name: chart.family.styles.get(name, Style()) for name in chart.solvers}
    return own | dict(zip((peer.name for peer in chart.family.peers), PEERS, strict=False))
