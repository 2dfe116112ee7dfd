"""Figures of leakage over the load."""

from collections.abc import Mapping, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.patches import Patch

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.figures.base import new_figure, size_of, surface_map, svg
from roughfilm.figures.ticks import plain_logarithmic
from roughfilm.rom.homogenization.flux import flux
from roughfilm.rom.seal.at_load import SealAtLoad
from roughfilm.rom.seal.leakage.direct import direct_flow
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.pools import Pool, constriction, pools
from roughfilm.rom.seal.leakage.series import SOUGHT, Row
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.scales import Scale

COLOURS = {"x": "#2166ac", "y": "#b2182b"}
LINES = {"direct": "-", "homogenized": (0, (4, 1.5))}
NAMES = {"direct": "one period", "homogenized": "periodic"}
ASKED = "#1a7f37"
"""Colour of the load of the scene."""

FLOW_RANGE = 1e-4
"""Ratio of the weakest flow that is drawn to the strongest; weaker flow is drawn as the weakest."""

LEAKAGE_RANGE = 1e-9
"""Ratio of the smallest leakage that is drawn to the greatest."""

POOLS = {
    Pool.CONTACT: ("#c9d1d9", "contact"),
    Pool.ISOLATED: ("#4d4d4d", "cut off"),
    Pool.INLET: ("#67a9cf", "fed from the inlet"),
    Pool.OUTLET: ("#ef8a62", "drained to the outlet"),
    Pool.THROUGH: ("#5aae61", "open from end to end"),
}


def areas(rows: Sequence[Row], thresholds: Mapping[str, Threshold], answer: SealAtLoad) -> str:
    """Contact area over the load, with the point at which each direction seals and that of the answer."""
    figure, axes = new_figure((5.4, 4.4))
    axes.plot(
        [row.load / 1e6 for row in rows], [100 * row.area_fraction for row in rows], "o-", color="0.35", markersize=4
    )
    for axis, size in zip("xy", (13, 9), strict=True):
        threshold = thresholds[f"direct_{axis}"]
        if threshold.bracketed:
            axes.plot(
                threshold.load / 1e6,
                100 * threshold.area_fraction,
                "o",
                markersize=size,
                markerfacecolor="none",
                markeredgewidth=2,
                color=COLOURS[axis],
                label=f"seals along {axis}",
            )
    area = answer.area_fraction
    axes.errorbar(
        answer.load / 1e6,
        100 * area.value,
        100 * (area.uncertainty or 0.0),
        fmt="D",
        markersize=8,
        color=ASKED,
        label=f"{answer.load / 1e6:.4g} MPa",
    )
    axes.set(xlim=(0, None), ylim=(0, None), xlabel="load, MPa", ylabel="contact area, % of the nominal area")
    figure.legend(loc="outside upper center", ncols=3, fontsize=9)
    return svg(figure)


def leakages(
    scene: Seal,
    rows: Sequence[Row],
    thresholds: Mapping[str, Threshold],
    estimated: Mapping[float, float],
    answer: SealAtLoad,
    scale: Scale,
) -> str:
    """Leakage over the load, of one period and periodic, in both directions; empty if nothing leaks at any load.

    ``estimated`` is the permeability of the effective medium, m³, by load; ``scale`` is the unit of the leakage.
    """
    if _lowest(rows) == 0:
        return ""
    figure, axes = new_figure((5.4, 4.4))
    lowest = max(_lowest(rows), LEAKAGE_RANGE * max(row.direct_x + row.direct_y for row in rows))
    for name in SOUGHT:
        kind, axis = name.split("_")
        loads, values = _open(rows, name)
        axes.plot(
            loads / 1e6,
            np.array([leakage_of(scene, value) for value in values]) / scale.factor,
            linestyle=LINES[kind],
            marker="o" if kind == "direct" else None,
            markersize=3,
            color=COLOURS[axis],
            label=f"{axis}, {NAMES[kind]}",
        )
        threshold = thresholds[name]
        if kind == "direct" and threshold.bracketed:
            axes.axvline(threshold.load / 1e6, color=COLOURS[axis], linewidth=0.9, linestyle=":")
    drawn = {load: value for load, value in estimated.items() if value > lowest}
    if drawn:
        axes.plot(
            np.array([*drawn]) / 1e6,
            np.array([leakage_of(scene, value) for value in drawn.values()]) / scale.factor,
            color="0.55",
            linewidth=1,
            label="effective medium",
        )
    if not answer.sealed:
        leak = answer.leakage_per_width.value / scale.factor
        axes.plot(answer.load / 1e6, leak, "D", color=ASKED, markersize=8, label=f"{scene.flow.direction}, whole seal")
    axes.set(
        xscale="log",
        yscale="log",
        ylim=(0.5 * leakage_of(scene, lowest) / scale.factor, None),
        xlabel="load, MPa (dotted: sealed beyond)",
        ylabel=f"leakage per width, {scale.unit}",
    )
    plain_logarithmic(axes.xaxis)
    figure.legend(fontsize=8, loc="outside upper center", ncols=3)
    return svg(figure)


def scaled(rows: Sequence[Row], valley_depth: float, composite_modulus: float) -> str:
    """Dimensionless leakage over dimensionless load, with Svm of the undeformed surface and of the loaded one."""
    figure, panels = new_figure((10.4, 4.0), 1, 2, sharey=True)
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
        axes.set(xscale="log", yscale="log", xlabel="load over the composite modulus E*")
        axes.set_title(f"valley depth Svm of the {'surface under load' if deformed else 'undeformed surface'}", size=9)
    panels[0].set_ylabel("leakage over that of\na smooth gap Svm high")
    figure.legend(*panels[0].get_legend_handles_labels(), fontsize=8, loc="outside upper center", ncols=2)
    return svg(figure)


def paths(contacts: Sequence[Contact], axis: int) -> str:
    """Maps of the flow between the ends at a few loads, and of the pools of each end where nothing flows."""
    contacts = [contact for contact in contacts if contact.gap.any()]
    length, width = size_of(contacts[0])
    height = min(5.0, max(1.8, 4.2 * width / length))
    rows = -(-len(contacts) // 2)
    figure, panels = new_figure((10.4, (height + 0.3) * rows + 0.5), rows, 2, squeeze=False)
    panels = panels.ravel()
    for axes in panels[len(contacts) :]:
        axes.set_axis_off()
    image, found = None, set()
    for axes, contact in zip(panels, contacts, strict=False):
        passage = direct_flow(contact.gap, contact.spacing, axis)
        title = f"{contact.load / 1e6:.4g} MPa, {100 * contact.area_fraction:.1f} % contact"
        if passage.sealed:
            found |= _pools(axes, contact, axis)
            axes.set_title(f"{title}: sealed", fontsize=9)
            continue
        size = np.hypot(*flux(contact.gap, contact.spacing, passage.corrector, axis))
        image = surface_map(
            axes,
            np.where(contact.gap > 0, np.maximum(size / size.max(), FLOW_RANGE), np.nan),
            size_of(contact),
            cmap=mpl.colormaps["magma"].with_extremes(bad=POOLS[Pool.CONTACT][0]),
            norm=LogNorm(FLOW_RANGE, 1.0),
        )
        narrow = constriction(contact.gap if axis == 0 else contact.gap.T)
        if narrow is not None:
            i, j = narrow.node if axis == 0 else narrow.node[::-1]
            place = i * contact.spacing[0] * 1e6, j * contact.spacing[1] * 1e6
            axes.plot(*place, "o", markersize=13, markerfacecolor="none", color="#00e5a0", markeredgewidth=2)
            title += f", narrowest {narrow.gap * 1e6:.3g} µm"
        axes.set_title(title, fontsize=9)
    if image is not None:
        figure.colorbar(image, ax=panels.tolist(), label="flow over the largest flow of the map", shrink=0.6)
    if found:
        handles = [Patch(color=colour, label=words) for pool, (colour, words) in POOLS.items() if pool in found]
        figure.legend(handles=handles, fontsize=9, loc="outside lower center", ncols=len(handles))
    return svg(figure)


def _pools(axes: Axes, contact: Contact, axis: int) -> set[Pool]:
    """Draw the pools of each end, and return those that there are."""
    ends = pools(contact.gap) if axis == 0 else pools(contact.gap.T).T
    colours = ListedColormap([colour for colour, _ in POOLS.values()])
    surface_map(axes, ends, size_of(contact), cmap=colours, vmin=-0.5, vmax=len(POOLS) - 0.5)
    return {pool for pool in POOLS if (ends == pool).any()}


def _open(rows: Sequence[Row], name: str) -> tuple[Array, Array]:
    """Loads and permeabilities where there is leakage."""
    some = [(row.load, getattr(row, name)) for row in rows if getattr(row, name) > 0]
    return np.array([load for load, _ in some]), np.array([value for _, value in some])


def _lowest(rows: Sequence[Row]) -> float:
    values = [getattr(row, name) for row in rows for name in SOUGHT if getattr(row, name) > 0]
    return min(values, default=0.0)
