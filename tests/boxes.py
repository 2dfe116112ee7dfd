"""The boxes of what a figure shows, and which of them overlap or leave the figure."""

import itertools
from typing import NamedTuple

from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

TOUCH = 0.75
"""Overlap that counts as contact of two boxes along both sides, in points."""


class Box(NamedTuple):
    """What it is, where it belongs, and its extent in points."""

    kind: str
    words: str
    owner: object
    extent: Bbox
    slanted: bool = False

    def __str__(self) -> str:
        return f"{self.kind} {self.words!r}"


def overlaps(figure: Figure) -> list[str]:
    """Pairs of texts, legends, colour bars and panels that overlap, and what leaves the figure, in words.

    A text may lie in its own panel. Slanted labels of one axis are not compared, because their boxes overlap before
    they do.
    """
    figure.set_dpi(72)
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    boxes = list(boxes_of(figure, renderer))
    edge = figure.bbox.padded(TOUCH)
    found = [f"{box} leaves the figure" for box in boxes if not _within(box.extent, edge)]
    for one, other in itertools.combinations(boxes, 2):
        if _may_overlap(one, other):
            continue
        common = Bbox.intersection(one.extent, other.extent)
        if common is not None and common.width > TOUCH and common.height > TOUCH:
            found.append(f"{one} overlaps {other}")
    return found


def boxes_of(figure, renderer):
    """Every box of a figure that has been drawn."""
    for text in figure.texts:
        if _shows(text):
            yield Box("text", text.get_text(), figure, text.get_window_extent(renderer))
    for legend in figure.legends:
        yield Box("legend", "of the figure", figure, legend.get_window_extent(renderer))
    for axes in figure.axes:
        if not axes.get_visible():
            continue
        bar = hasattr(axes, "_colorbar")
        if axes.axison:
            yield Box("colour bar" if bar else "panel", axes.get_title(), axes, axes.get_window_extent(renderer))
            for axis in (axes.xaxis, axes.yaxis, *(side for one in axes.child_axes for side in (one.xaxis, one.yaxis))):
                yield from _labels(axis, axes, renderer)
        for title in (axes.title, axes._left_title, axes._right_title):
            if _shows(title):
                yield Box("title", title.get_text(), axes, title.get_window_extent(renderer))
        if axes.get_legend() is not None:
            yield Box("legend", axes.get_title(), axes, axes.get_legend().get_window_extent(renderer))
        for text in axes.texts:
            drawn = not isinstance(text, Annotation) or text._check_xy(renderer)
            if _shows(text) and drawn:
                yield Box("text", text.get_text(), axes, Text.get_window_extent(text, renderer))


def _labels(axis: Axis, owner, renderer):
    """The labels of the ticks within the limits of an axis, and its own label."""
    if not axis.get_visible():
        return
    low, high = sorted(axis.get_view_interval())
    margin = 1e-9 * (high - low)
    for ticks in (axis.get_major_ticks(), axis.get_minor_ticks()):
        for tick in ticks:
            inside = low - margin <= tick.get_loc() <= high + margin
            for label in (tick.label1, tick.label2):
                if tick.get_visible() and inside and _shows(label):
                    slanted = label.get_rotation() % 90 != 0
                    yield Box("tick", label.get_text(), owner, label.get_window_extent(renderer), slanted)
    for label in (axis.label, axis.get_offset_text()):
        if _shows(label):
            yield Box("label", label.get_text(), owner, label.get_window_extent(renderer))


def _shows(text: Text) -> bool:
    return text.get_visible() and bool(text.get_text().strip())


def _within(extent: Bbox, edge: Bbox) -> bool:
    return extent.x0 >= edge.x0 and extent.y0 >= edge.y0 and extent.x1 <= edge.x1 and extent.y1 <= edge.y1


def _may_overlap(one: Box, other: Box) -> bool:
    """Whether two boxes may share a place: a panel and what is drawn in it, twins, slanted neighbours."""
    if one.slanted and other.slanted and one.owner is other.owner:
        return True
    kinds = {one.kind, other.kind}
    if kinds == {"panel"}:
        return one.extent.bounds == other.extent.bounds
    if "panel" in kinds:
        panel, inner = (one, other) if one.kind == "panel" else (other, one)
        same = getattr(inner.owner, "bbox", None)
        return inner.owner is panel.owner or (same is not None and same.bounds == panel.owner.bbox.bounds)
    return False
