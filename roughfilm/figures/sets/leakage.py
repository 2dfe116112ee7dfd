"""Figures of the leakage of a seal whose surface is known in several windows."""

import numpy as np

from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.leakage import ASKED, COLOURS, LEAKAGE_RANGE
from roughfilm.figures.sets.bands import draw_bands, explain_bands
from roughfilm.figures.ticks import plain_logarithmic
from roughfilm.rom.seal.leakage.windows import SealOfWindows
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.scales import Scale


def leakages(scene: Seal, seal: SealOfWindows, scale: Scale) -> str:
    """Leakage per width over the load, a panel for each direction; empty if nothing leaks at any load."""
    drawn = {axis: [one.scaled(leakage_of(scene, 1.0)) for one in seal.numbers[f"direct_{axis}"]] for axis in "xy"}
    largest = max(one.value for averages in drawn.values() for one in averages)
    if largest <= 0:
        return ""
    least = min(one.value for averages in drawn.values() for one in averages if one.value > 0)
    figure, panels = new_figure((11.4, 4.6), 1, 2, sharey=True)
    megapascals = [load / 1e6 for load in seal.loads]
    for axes, (axis, averages) in zip(panels, drawn.items(), strict=True):
        axes.set(xscale="log", yscale="log")
        draw_bands(
            axes,
            megapascals,
            [one.scaled(1 / scale.factor) for one in averages],
            COLOURS[axis],
            f"mean over {seal.count} windows" if axis == scene.flow.direction else "",
        )
        lanes = np.array([leakage_of(scene, one) for one in seal.in_series[f"direct_{axis}"]]) / scale.factor
        shown = lanes > LEAKAGE_RANGE * largest / scale.factor
        if seal.periods["xy".index(axis)] > 1:
            axes.plot(
                np.array(megapascals)[shown],
                lanes[shown],
                color=COLOURS[axis],
                linewidth=1,
                linestyle=(0, (4, 1.5)),
                label="windows in lanes" if axis == scene.flow.direction else "",
            )
        axes.set_title(f"along {axis}", fontsize=10)
        axes.set_xlabel("load, MPa")
        plain_logarithmic(axes.xaxis)
        if seal.loads[0] <= seal.load <= seal.loads[-1]:
            axes.axvline(seal.load / 1e6, color=ASKED, linewidth=1, linestyle=":", zorder=0)
    panels[0].set(ylabel=f"leakage per width, {scale.unit}")
    top = max(one.interval[1] if one.interval else one.value for averages in drawn.values() for one in averages[:1])
    bottom = 0.3 * max(least, LEAKAGE_RANGE * largest)
    panels[0].set_ylim(bottom / scale.factor, 3 * max(top, largest) / scale.factor)
    explain_bands(figure, panels["xy".index(scene.flow.direction)])
    return svg(figure)


def contacts(seal: SealOfWindows) -> str:
    """Contact area and mean gap over the load."""
    figure, (area, gap) = new_figure((11.4, 4.4), 1, 2)
    megapascals = [load / 1e6 for load in seal.loads]
    for axes, name, factor, label in (
        (area, "area_fraction", 0.01, "contact area, % of the nominal area"),
        (gap, "mean_gap", 1e-6, "mean gap, µm"),
    ):
        averages = [one.scaled(1 / factor) for one in seal.numbers[name]]
        draw_bands(axes, megapascals, averages, "0.25", f"mean over {seal.count} windows")
        axes.set(xscale="log", ylim=(0, None), xlabel="load, MPa", ylabel=label)
        plain_logarithmic(axes.xaxis)
    explain_bands(figure, area)
    return svg(figure)


def sealed(seal: SealOfWindows) -> str:
    """The fraction of sealed windows over the load, in both directions, one period between reservoirs."""
    figure, axes = new_figure((7.4, 4.0))
    for axis in "xy":
        sealing = seal.sealing[f"direct_{axis}"]
        if sealing.load is not None:
            loads = np.sort(sealing.load.values) / 1e6
            steps = 100 * np.arange(1, loads.size + 1) / loads.size
            first = min(seal.loads[0] / 1e6, loads[0])
            places = np.concatenate([[first], loads, [max(seal.loads[-1] / 1e6, loads[-1])]])
            axes.plot(
                places,
                [0, *steps, 100],
                drawstyle="steps-post",
                color=COLOURS[axis],
                linewidth=1.4,
                label=f"along {axis}",
            )
        else:
            fractions = [100 * one.zeros for one in seal.numbers[f"direct_{axis}"]]
            axes.plot(
                [load / 1e6 for load in seal.loads],
                fractions,
                "o-",
                color=COLOURS[axis],
                linewidth=1.4,
                markersize=3,
                label=f"along {axis}",
            )
    axes.axvline(seal.load / 1e6, color=ASKED, linewidth=1, linestyle=":", label=f"{seal.load / 1e6:.4g} MPa", zorder=0)
    axes.set(xscale="log", ylim=(-3, 103), xlabel="load, MPa", ylabel="sealed windows, %")
    plain_logarithmic(axes.xaxis)
    figure.legend(fontsize=9, loc="outside upper center", ncols=3)
    return svg(figure)
