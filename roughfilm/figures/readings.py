"""What a page shows under the pointer: the series and maps of a figure, derived from what was drawn."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PathCollection, QuadMesh
from matplotlib.container import BarContainer, ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Rectangle, StepPatch
from matplotlib.ticker import FixedFormatter, FixedLocator, FuncFormatter
from scipy.spatial import cKDTree

from roughfilm.contact.foundation.arrays import Array

MAX_POINTS = 200
"""Points of a series at most."""

MAX_CELLS = 40
"""Cells of a map along a side at most."""

POINTS_PER_INCH = 72
"""Units of an SVG picture."""


def readings(figure: Figure) -> list[dict[str, Any]]:
    """Return the readings of each axes of a figure that has been drawn; lengths are points from its upper left corner.

    An entry has its ``box`` (left, top, width, height), its ``title``, and ``x`` and ``y``: name, unit, scale, limits
    and the names of its places. Its ``series`` have a label, flat ``points`` of five numbers (two lengths, x, y,
    uncertainty) and ``of``, the axis of the uncertainty. Its ``map``, if it has one, has its quantity, the numbers of
    its cells along both sides, and their values by rows from the upper left corner, null where there is none.
    """
    found = []
    for axes in figure.axes:
        if not axes.get_visible() or not axes.axison or hasattr(axes, "_colorbar"):
            continue
        window = axes.get_position()
        width, height = (POINTS_PER_INCH * size for size in figure.get_size_inches())
        box = (window.x0 * width, (1 - window.y1) * height, window.width * width, window.height * height)
        series = [one for entry in _series(axes) if (one := _drawn(axes, box, *entry))]
        maps = [one for artist in (*axes.images, *axes.collections) if (one := _map(axes, artist))]
        if series or maps:
            panel: dict[str, Any] = {"box": [round(side, 1) for side in box], "title": axes.get_title()}
            panel |= {"x": _axis(axes.xaxis, figure), "y": _axis(axes.yaxis, figure), "series": series}
            found.append(panel | ({"map": maps[-1]} if maps else {}))
    return found


def name_and_unit(label: str) -> tuple[str, str]:
    """Return the name and the unit of a quantity from the label of an axis.

    >>> name_and_unit("position along the sliding wall, mm (dashed: groove edges)")
    ('position along the sliding wall', 'mm')
    >>> name_and_unit("p+ = 100 p Ly² / (η u Lx)")
    ('p+', '')
    """
    name, _, rest = " ".join(label.split()).partition(", ")
    return name.split(" = ")[0].split(" (")[0], rest.split(" (")[0].split(", ")[0]


def _axis(axis: Axis, figure: Figure) -> dict[str, Any]:
    """Name and unit of the quantity along an axis, its own label, else that of axes that share it or of the figure."""
    own = axis.axes
    grouper, shared = (own.get_shared_x_axes(), "xaxis") if axis is own.xaxis else (own.get_shared_y_axes(), "yaxis")
    labels = [axis.get_label_text(), *(getattr(one, shared).get_label_text() for one in grouper.get_siblings(own))]
    labels.append(figure.get_supxlabel() if axis is own.xaxis else figure.get_supylabel())
    name, unit = name_and_unit(next(filter(None, labels), "x" if axis is own.xaxis else "y"))
    places, texts = axis.get_major_locator(), axis.get_major_formatter()
    entry: dict[str, Any] = {"name": name, "unit": unit, "scale": axis.get_scale()}
    entry["limits"] = [_short(limit, 12) for limit in axis.get_view_interval()]
    if isinstance(places, FixedLocator) and isinstance(texts, FixedFormatter | FuncFormatter):
        names = [(float(place), texts(place, i)) for i, place in enumerate(axis.get_majorticklocs())]
        entry["places"] = [[_short(place), text] for place, text in names if text]
    return entry


def _series(axes: Axes) -> Iterator[tuple[str, Array, Array, Array | None, str]]:
    """Label, x, y, uncertainty and its axis of each series that is drawn in the coordinates of the axes."""
    barred: dict[Any, tuple[str, Array | None, str] | None] = {}
    for container in axes.containers:
        if isinstance(container, ErrorbarContainer):
            line, caps, bars = container
            label, of = _label(container), "y" if container.has_yerr else "x"
            half = _half_lengths(bars, "xy".index(of))
            if line is None:
                segments = [segment.mean(axis=0) for one in bars for segment in one.get_segments()]
                middle = np.array(segments).reshape(-1, 2)
                yield label, middle[:, 0], middle[:, 1], half, of
            else:
                barred[line] = (label, half, of)
            barred |= dict.fromkeys(caps, None)
        elif isinstance(container, BarContainer):
            yield _bars(container)
    for line in axes.lines:
        known = barred.get(line, (_label(line), None, "y"))
        if line.get_visible() and line.get_transform() == axes.transData and known is not None:
            x, y = (_filled(part) for part in line.get_data(orig=False))
            label, bars_of_line, of = known
            complete = bars_of_line is not None and bars_of_line.size == x.size
            yield label, x, y, bars_of_line if complete else None, of
    for collection in axes.collections:
        if isinstance(collection, PathCollection) and collection.get_offset_transform() == axes.transData:
            places = _filled(collection.get_offsets())
            yield _label(collection), places[:, 0], places[:, 1], None, "y"
    for patch in axes.patches:
        if isinstance(patch, StepPatch):
            values, edges, _ = patch.get_data()
            yield _label(patch), (edges[1:] + edges[:-1]) / 2, _filled(values), None, "y"


def _filled(values: Any) -> Array:
    """Numbers with NaN for what is masked."""
    return np.asarray(np.ma.filled(np.ma.asarray(values, np.float64), np.nan))


def _bars(container: BarContainer) -> tuple[str, Array, Array, None, str]:
    """The ends of bars."""
    patches = [patch for patch in container.patches if isinstance(patch, Rectangle)]
    lying = container.orientation == "horizontal"
    x = np.array([one.get_x() + one.get_width() * (1 if lying else 0.5) for one in patches])
    y = np.array([one.get_y() + one.get_height() * (0.5 if lying else 1) for one in patches])
    return _label(container), x, y, None, "y"


def _half_lengths(bars: Sequence[LineCollection], axis: int) -> Array:
    """Half of the length of each bar of uncertainty along an axis; 0 of an infinite one, which is not drawn."""
    segments = [np.asarray(segment) for one in bars[-1:] for segment in one.get_segments()]
    return np.array([np.ptp(segment[:, axis]) / 2 if segment.size else 0.0 for segment in segments])


def _label(artist: Any) -> str:
    label = str(artist.get_label())
    return "" if label.startswith("_") else label


def _drawn(
    axes: Axes, box: Sequence[float], label: str, x: Array, y: Array, bars: Array | None, of: str
) -> dict[str, Any]:
    """A series as the page has it: points in the box, thinned, with extreme values kept; empty if it has none."""
    place = axes.transAxes.inverted().transform(axes.transData.transform(np.column_stack([x, y])))
    inside = np.flatnonzero((np.isfinite(place) & (place > -1e-6) & (place < 1 + 1e-6)).all(axis=1))
    if not inside.size:
        return {}
    if inside.size > MAX_POINTS:
        kept = np.linspace(0, inside.size - 1, MAX_POINTS - 2).round().astype(int)
        inside = inside[np.unique([*kept, int(y[inside].argmin()), int(y[inside].argmax())])]
    points: list[Any] = []
    for i in inside:
        points += [round(box[0] + place[i, 0] * box[2], 1), round(box[1] + (1 - place[i, 1]) * box[3], 1)]
        points += [_short(x[i]), _short(y[i]), 0 if bars is None else _short(bars[i])]
    return {"label": label, "of": of, "points": points}


def _map(axes: Axes, artist: Any) -> dict[str, Any]:
    """The values of a picture or mesh on cells of the axes; empty if it is none or has no values."""
    if not isinstance(artist, AxesImage | QuadMesh):
        return {}
    values = _filled([] if artist.get_array() is None else artist.get_array())
    if values.ndim > 2 or not values.size:
        return {}
    box = axes.get_window_extent()
    columns = MAX_CELLS if box.width > box.height else max(2, round(MAX_CELLS * box.width / box.height))
    rows = max(2, round(columns * box.height / box.width))
    across, down = (np.arange(columns) + 0.5) / columns, 1 - (np.arange(rows) + 0.5) / rows
    wanted = np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2)
    to_axes = axes.transData + axes.transAxes.inverted()
    if isinstance(artist, AxesImage):
        left, right, bottom, top = artist.get_extent()
        x, y = to_axes.inverted().transform(wanted).T
        if artist.origin == "upper":
            bottom, top = top, bottom
        i, j = ((y - bottom) / (top - bottom) * values.shape[0], (x - left) / (right - left) * values.shape[1])
        within = (i >= 0) & (i < values.shape[0]) & (j >= 0) & (j < values.shape[1])
        found = np.full(len(wanted), np.nan)
        found[within] = values[i[within].astype(int), j[within].astype(int)]
    else:
        places = np.asarray(artist.get_coordinates())
        corners = to_axes.transform(places.reshape(-1, 2)).reshape(places.shape)
        found = _of_mesh(corners, values.reshape(-1), wanted)
    if not np.isfinite(found).any():
        return {}
    name, unit = name_and_unit(_bar_label(artist, axes.figure))
    return {"name": name, "unit": unit, "columns": columns, "rows": rows, "values": [_short(one, 3) for one in found]}


def _of_mesh(corners: Array, values: Array, wanted: Array) -> Array:
    """The value of the cell, or of the node, around each wanted place; NaN outside."""
    if corners.shape[0] * corners.shape[1] == values.size:
        centres, reach = corners.reshape(-1, 2), np.ptp(corners.reshape(-1, 2), axis=0) / np.array(corners.shape[1::-1])
        low, high = centres - reach, centres + reach
    else:
        parts = np.stack([corners[:-1, :-1], corners[1:, :-1], corners[:-1, 1:], corners[1:, 1:]])
        parts = parts.reshape(4, -1, 2)
        centres, low, high = parts.mean(axis=0), parts.min(axis=0), parts.max(axis=0)
    found = np.full(len(wanted), np.nan)
    _, near = cKDTree(centres).query(wanted, k=min(9, len(centres)))
    for cell in np.atleast_2d(near.T)[::-1]:
        inside = ((wanted >= low[cell]) & (wanted <= high[cell])).all(axis=1)
        found[inside] = values[cell[inside]]
    return found


def _bar_label(artist: ScalarMappable, figure: Any) -> str:
    """The label of the colour bar of a map, or of one with the same colours."""
    for axes in figure.axes:
        bar = getattr(axes, "_colorbar", None)
        if bar is not None and (bar.mappable is artist or bar.norm is artist.norm or _alike(bar.mappable, artist)):
            return str(bar.ax.get_ylabel() or bar.ax.get_xlabel() or "value")
    return "value"


def _alike(one: ScalarMappable, other: ScalarMappable) -> bool:
    return one.cmap.name == other.cmap.name and one.get_clim() == other.get_clim()


def _short(value: float, digits: int = 4) -> float | int | None:
    """A number with some digits, as short as JSON can hold it; None for NaN and infinity."""
    if not np.isfinite(value):
        return None
    short = float(f"{value:.{digits}g}")
    return int(short) if short == int(short) and abs(short) < 1e15 else short
