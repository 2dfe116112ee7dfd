"""The pictures of a series of leakage."""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.figures.base import svg
from roughfilm.rom.homogenization.flux import flux
from roughfilm.rom.seal.leakage.direct import direct_flow
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.pools import Pool, constriction, pools
from roughfilm.rom.seal.leakage.series import SOUGHT, Row
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal

COLOURS = {"x": "#2166ac", "y": "#b2182b"}
LINES = {"direct": "-", "homogenized": (0, (4, 1.5))}
NAMES = {"direct": "directly", "homogenized": "averaged"}
PER_HOUR = 3600
MOST_PIXELS = 400
"""Of a map along a side."""

WEAKEST = 1e-4
"""Of the strongest flow; weaker ones are drawn as that."""

DEEPEST = 1e-9
"""Of the greatest leakage; a curve that falls on to nothing is cut there."""

POOLS = {
    Pool.CONTACT: ("#c9d1d9", "contact"),
    Pool.ISOLATED: ("#4d4d4d", "cut off"),
    Pool.INLET: ("#67a9cf", "fed from the inlet"),
    Pool.OUTLET: ("#ef8a62", "drained to the outlet"),
    Pool.THROUGH: ("#5aae61", "from end to end"),
}


def areas(rows: Sequence[Row], found: Mapping[str, Threshold]) -> str:
    """Real area against load, with where each direction seals between ends."""
    figure, axes = _small()
    axes.plot(
        [row.load / 1e6 for row in rows], [100 * row.area_fraction for row in rows], "o-", color="0.35", markersize=4
    )
    for axis in "xy":
        threshold = found[f"direct_{axis}"]
        if threshold.found:
            axes.plot(
                threshold.load / 1e6,
                100 * threshold.area_fraction,
                "o",
                markersize=11,
                markerfacecolor="none",
                markeredgewidth=2,
                color=COLOURS[axis],
                label=f"seals in {axis}, {100 * threshold.area_fraction:.1f} %",
            )
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="lower right")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("load, MPa")
    axes.set_ylabel("contact area, % of the nominal area")
    return svg(figure)


def leakages(scene: Seal, rows: Sequence[Row], found: Mapping[str, Threshold], estimated: Mapping[float, float]) -> str:
    """Leakage against load, directly and averaged, in both directions; ``estimated`` is K, m³, by load.

    Empty if nothing leaks at any load.
    """
    if _lowest(rows) == 0:
        return ""
    figure, axes = _small()
    lowest = max(_lowest(rows), DEEPEST * max(row.direct_x + row.direct_y for row in rows))
    for name in SOUGHT:
        kind, axis = name.split("_")
        loads, values = _open(rows, name)
        axes.plot(
            loads / 1e6,
            PER_HOUR * np.array([leakage_of(scene, value) for value in values]),
            linestyle=LINES[kind],
            marker="o" if kind == "direct" else None,
            markersize=3,
            color=COLOURS[axis],
            label=f"{axis}, {NAMES[kind]}",
        )
        threshold = found[name]
        if kind == "direct" and threshold.found:
            axes.axvline(threshold.load / 1e6, color=COLOURS[axis], linewidth=0.9, linestyle=":")
    told = {load: value for load, value in estimated.items() if value > lowest}
    if told:
        axes.plot(
            np.array([*told]) / 1e6,
            [PER_HOUR * leakage_of(scene, value) for value in told.values()],
            color="0.55",
            linewidth=1,
            label="effective medium",
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(bottom=0.5 * PER_HOUR * leakage_of(scene, lowest))
    axes.set_xlabel("load, MPa (dotted: sealed beyond)")
    axes.set_ylabel("leakage per width, kg/h/m")
    axes.legend(fontsize=8, loc="lower left")
    return svg(figure)


def scaled(rows: Sequence[Row], valley_depth: float, composite_modulus: float) -> str:
    """Dimensionless leakage against dimensionless load: over Svm of the surface as it was, and as it is under load."""
    figure = Figure(figsize=(10.4, 3.9), layout="constrained")
    panels = figure.subplots(1, 2, sharey=True)
    for axes, deformed in zip(panels, (False, True), strict=True):
        for axis in "xy":
            name = f"direct_{axis}"
            some = [row for row in rows if getattr(row, name) > 0]
            depths = np.array([row.valley_depth if deformed else valley_depth for row in some])
            values = np.array([getattr(row, name) for row in some]) / depths**3
            axes.plot(
                [row.load / composite_modulus for row in some],
                values,
                "o-",
                markersize=3,
                color=COLOURS[axis],
                label=f"in {axis}",
            )
        axes.axhline(1.0, color="black", linewidth=0.8, linestyle=":")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("load over E*")
        axes.set_title("over Svm of the surface under load" if deformed else "over Svm of the surface", fontsize=9)
    panels[0].set_ylabel("leakage 12ηQ/(Svm³ Δp)")
    panels[0].legend(fontsize=8)
    return svg(figure)


def paths(contacts: Sequence[Contact], axis: int) -> str:
    """Where it flows, between ends, at a few loads; what belongs to which end where nothing does."""
    contacts = [contact for contact in contacts if contact.gap.any()]
    length, width = _size(contacts[0])
    height = min(5.0, max(1.8, 4.2 * width / length))
    figure = Figure(figsize=(10.4, (height + 0.3) * -(-len(contacts) // 2)), layout="constrained")
    panels = figure.subplots(-(-len(contacts) // 2), 2, squeeze=False).ravel()
    for axes in panels[len(contacts) :]:
        axes.set_axis_off()
    for axes, contact in zip(panels, contacts, strict=False):
        passage = direct_flow(contact.gap, contact.spacing, axis)
        title = f"{contact.load / 1e6:.4g} MPa, {100 * contact.area_fraction:.1f} % contact"
        if passage.sealed:
            _pools(axes, contact, axis)
            axes.set_title(f"{title}: sealed", fontsize=9)
            continue
        size = np.hypot(*flux(contact.gap, contact.spacing, passage.corrector, axis)) / passage.permeability
        _map(
            axes,
            contact,
            np.where(contact.gap > 0, np.maximum(size, WEAKEST * size.max()), np.nan),
            cmap=mpl.colormaps["magma"].with_extremes(bad=POOLS[Pool.CONTACT][0]),
            norm=LogNorm(WEAKEST * size.max(), size.max()),
        )
        narrow = constriction(contact.gap if axis == 0 else contact.gap.T)
        if narrow is not None:
            i, j = narrow.node if axis == 0 else narrow.node[::-1]
            place = i * contact.spacing[0] * 1e6, j * contact.spacing[1] * 1e6
            axes.plot(*place, "o", markersize=13, markerfacecolor="none", color="#00e5a0", markeredgewidth=2)
            title += f", narrowest {_length(narrow.gap)}"
        axes.set_title(title, fontsize=9)
    return svg(figure)


def _length(gap: float) -> str:
    return f"{gap * 1e6:.3g} µm" if gap >= 1e-7 else f"{gap * 1e9:.3g} nm"


def _pools(axes: Axes, contact: Contact, axis: int) -> None:
    found = pools(contact.gap) if axis == 0 else pools(contact.gap.T).T
    colours = ListedColormap([colour for colour, _ in POOLS.values()])
    _map(axes, contact, found, cmap=colours, vmin=-0.5, vmax=len(POOLS) - 0.5)
    for pool, (colour, words) in POOLS.items():
        if (found == pool).any():
            axes.plot([], [], "s", color=colour, label=words)
    axes.legend(fontsize=7, loc="lower center", bbox_to_anchor=(0.5, 1.06), ncols=4, handletextpad=0.2)


def _map(axes: Axes, contact: Contact, values: NDArray[Any], **how: Any) -> None:
    step = max(1, -(-max(values.shape) // MOST_PIXELS))
    length, width = _size(contact)
    axes.grid(visible=False)
    axes.imshow(
        values[::step, ::step].T,
        origin="lower",
        extent=(0, length, 0, width),
        interpolation="nearest",
        **how,
    )
    axes.set_xlabel("x, µm")
    axes.set_ylabel("y, µm")


def _size(contact: Contact) -> tuple[float, float]:
    nx, ny = contact.heights.shape
    return nx * contact.spacing[0] * 1e6, ny * contact.spacing[1] * 1e6


def _small() -> tuple[Figure, Axes]:
    figure = Figure(figsize=(5.4, 4.2), layout="constrained")
    return figure, figure.add_subplot()


def _open(rows: Sequence[Row], name: str) -> tuple[Array, Array]:
    """Loads and permeabilities where there is leakage."""
    some = [(row.load, getattr(row, name)) for row in rows if getattr(row, name) > 0]
    return np.array([load for load, _ in some]), np.array([value for _, value in some])


def _lowest(rows: Sequence[Row]) -> float:
    values = [getattr(row, name) for row in rows for name in SOUGHT if getattr(row, name) > 0]
    return min(values, default=0.0)
