"""Figures of stiffness and damping over speed, of the place of a shaft, and of the stability of its rotor."""

import itertools
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.interpolate import PchipInterpolator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from roughfilm.figures.stribeck import COLOURS, LOGARITHMIC_RATIO
from roughfilm.figures.ticks import plain_logarithmic
from roughfilm.rom.bearing.dynamics.point import ENTRIES
from roughfilm.rom.bearing.dynamics.store import dimensionless_of
from roughfilm.rom.bearing.dynamics.sweep import DynamicCurve
from roughfilm.rom.bearing.dynamics.whirl import RATIOS_OF_MEMORY
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.words.dynamics import own_point
from roughfilm.words.stribeck import speed_scale

STYLES = ("-", (0, (6, 1)), (0, (4, 1, 1, 1)), (0, (1, 1)))
"""Lines of the loads."""

CIRCLE = np.linspace(0, 2 * np.pi, 181)


def coefficients(scene: Bearing, curves: Sequence[DynamicCurve], *, dimensionless: bool) -> Figure:
    """The entries of stiffness and damping over speed, by their sizes; circles mark negative ones.

    ``dimensionless`` entries are K c/W and B c ω/W of a shaft.
    """
    scale = speed_scale(scene)
    figure, panels = new_figure((11.4, 4.4), 1, 2)
    shaft = "stiffness_xx" in curves[0].points[0].numbers
    units = {"stiffness": ("N/µm", 1e-6, "K c/W"), "damping": ("kN·s/m", 1e-3, "B c ω/W")}
    per_width = "/m" if scene.wide else ""
    for axes, (matrix, (unit, factor, name)) in zip(panels, units.items(), strict=True):
        for curve, style in zip(curves, itertools.cycle(STYLES), strict=False):
            speeds = _speeds(curve, scale.factor)
            for entry, colour in zip(ENTRIES[2 if shaft else 1], COLOURS, strict=False):
                key = f"{matrix}{entry}"
                values = np.array([point.numbers[key] for point in curve.points]) * factor
                errors = np.array([point.uncertainty[key] for point in curve.points]) * factor
                if dimensionless:
                    ratios = [dimensionless_of(scene, point)[f"dimensionless_{key}"] for point in curve.points]
                    errors *= np.divide(ratios, values, out=np.zeros_like(errors), where=values != 0)
                    values = np.array(ratios)
                label = entry[1:] if curve is curves[0] and shaft else None
                axes.plot(speeds, np.abs(values), color=colour, linestyle=style, linewidth=1.4, label=label)
                axes.fill_between(
                    speeds,
                    np.maximum(np.abs(values) - np.abs(errors), np.abs(values) * 1e-2),
                    np.abs(values) + np.abs(errors),
                    color=colour,
                    alpha=0.2,
                    linewidth=0,
                )
                below = values < 0
                axes.plot(
                    speeds[below],
                    np.abs(values[below]),
                    color=colour,
                    linestyle="none",
                    marker="o",
                    markersize=3.5,
                    markerfacecolor="white",
                )
        axes.set_yscale("log")
        _speed_axis(axes, curves, scale.factor, scale.unit)
        plain_logarithmic(axes.yaxis)
        axes.set_ylabel(f"{matrix} {name}" if dimensionless else f"{matrix}, {unit}{per_width}")
        axes.axvline(scale.factor * abs(scene.motion.speed), color="0.35", linewidth=1, linestyle="--", zorder=0)
    if shaft:
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


def over_frequency(scene: Bearing, curves: Sequence[DynamicCurve]) -> Figure:
    """The entries of stiffness and damping of a shaft at its own speed, over the frequency of its motion.

    Points are frequencies that are solved, with monotone cubics between them. A vertical line marks the frequency of
    the whirl at the threshold of stability, and a band the frequencies at which those of slow motions hold within 5 %.
    """
    figure, panels = new_figure((11.4, 4.4), 1, 2)
    ratios = np.geomspace(RATIOS_OF_MEMORY[0], RATIOS_OF_MEMORY[-1], 400)
    points = [own_point(scene, curve) for curve in curves]
    per_width = "/m" if scene.wide else ""
    for axes, (matrix, unit, factor) in zip(
        panels, (("stiffness", "N/µm", 1e-6), ("damping", "kN·s/m", 1e-3)), strict=True
    ):
        for point, style in zip(points, itertools.cycle(STYLES), strict=False):
            for entry, colour in zip(ENTRIES[2], COLOURS, strict=False):
                known = factor * np.array(point.spectrum[f"{matrix}{entry}"])
                label = entry[1:] if point is points[0] else None
                line = PchipInterpolator(RATIOS_OF_MEMORY, known)(ratios)
                axes.plot(ratios, line, color=colour, linestyle=style, linewidth=1.4, label=label)
                axes.plot(RATIOS_OF_MEMORY, known, color=colour, linestyle="none", marker="o", markersize=2.5)
            whirl = point.numbers["whirl_ratio"]
            if whirl > 0:
                name = "whirl at the threshold" if point is points[0] else None
                axes.axvline(whirl, color="black", linestyle=style, linewidth=0.9, label=name, zorder=0)
        slow = min(point.numbers["slow_ratio"] for point in points)
        axes.axvspan(ratios[0], np.clip(slow, ratios[0], ratios[-1]), color="0.5", alpha=0.12, linewidth=0, zorder=-1)
        axes.axvline(1.0, color="0.35", linewidth=1, linestyle="--", zorder=0)
        axes.set(xscale="log", xlim=(ratios[0], ratios[-1]), xlabel="frequency of the motion over the rotational speed")
        plain_logarithmic(axes.xaxis)
        axes.set_ylabel(f"{matrix}, {unit}{per_width}")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=5)
    return figure


def places(scene: Bearing, curves: Sequence[DynamicCurve]) -> Figure:
    """The place of the shaft over the clearance at all speeds, and its eccentricity and attitude over speed."""
    scale = speed_scale(scene)
    figure, (locus, over, angle) = new_figure((11.4, 4.0), 1, 3)
    locus.plot(np.cos(CIRCLE), np.sin(CIRCLE), color="0.35", linewidth=1, linestyle="--")
    locus.set_aspect("equal")
    locus.set(xlabel="eccentricity x", ylabel="eccentricity y")
    for curve, colour in zip(curves, itertools.cycle(COLOURS), strict=False):
        speeds = _speeds(curve, scale.factor)
        label = f"load {curve.pressure / 1e6:.4g} MPa"
        along, up = (np.array([point.numbers[f"eccentricity_{axis}"] for point in curve.points]) for axis in "xy")
        locus.plot(along, up, color=colour, marker="o", markersize=2.5, linewidth=1.2, label=label)
        for axes, name in ((over, "eccentricity"), (angle, "attitude_angle")):
            axes.plot(speeds, [point.numbers.get(name, np.nan) for point in curve.points], color=colour)
    for axes, label in ((over, "eccentricity over the clearance"), (angle, "attitude angle, °")):
        _speed_axis(axes, curves, scale.factor, scale.unit)
        axes.set_ylabel(label)
        axes.axvline(scale.factor * abs(scene.motion.speed), color="0.35", linewidth=1, linestyle="--", zorder=0)
    figure.legend(*locus.get_legend_handles_labels(), loc="outside upper center", ncols=6)
    return figure


def stability(scene: Bearing, curves: Sequence[DynamicCurve]) -> Figure:
    """The whirl ratio and the largest mass of a stable rigid rotor over speed, without a line where any is stable."""
    scale = speed_scale(scene)
    figure, (ratio, mass) = new_figure((11.4, 4.0), 1, 2)
    finite = False
    for curve, colour in zip(curves, itertools.cycle(COLOURS), strict=False):
        speeds = _speeds(curve, scale.factor)
        label = f"load {curve.pressure / 1e6:.4g} MPa"
        ratio.plot(speeds, [point.numbers["whirl_ratio"] for point in curve.points], color=colour, label=label)
        masses = np.array([point.numbers["critical_mass"] for point in curve.points])
        masses = np.where(np.isfinite(masses) & (masses > 0), masses, np.nan)
        finite = finite or bool(np.isfinite(masses).any())
        mass.plot(speeds, masses, color=colour, marker="o", markersize=2.5)
        if curve.onset is not None:
            mass.axhline(curve.onset.mass, color="black", linewidth=0.9, linestyle=":")
            if np.isfinite(curve.onset.rotation):
                sliding = curve.onset.rotation * (scene.turning_radius or 1.0)
                mass.axvline(scale.factor * sliding, color=colour, linewidth=0.9, linestyle=":")
    if finite:
        mass.set_yscale("log")
        plain_logarithmic(mass.yaxis)
    else:
        mass.text(0.5, 0.5, "stable at any mass", ha="center", transform=mass.transAxes)
    ratio.set_ylim(bottom=0)
    for axes, label in ((ratio, "whirl ratio"), (mass, "critical mass, kg")):
        _speed_axis(axes, curves, scale.factor, scale.unit)
        axes.set_ylabel(label)
        axes.axvline(scale.factor * abs(scene.motion.speed), color="0.35", linewidth=1, linestyle="--", zorder=0)
    figure.legend(*ratio.get_legend_handles_labels(), loc="outside upper center", ncols=6)
    return figure


def temperatures(scene: Bearing, curves: Sequence[DynamicCurve]) -> Figure:
    """The temperatures of the film and, dashed, of what leaves it over speed; bands are known uncertainties."""
    scale = speed_scale(scene)
    figure, axes = new_figure((11.4, 3.8))
    for curve, colour in zip(curves, itertools.cycle(COLOURS), strict=False):
        speeds = _speeds(curve, scale.factor)
        for name, style in (("temperature", "-"), ("outlet_temperature", "--")):
            values = np.array([point.numbers[name] for point in curve.points])
            errors = np.nan_to_num([point.uncertainty[name] for point in curve.points], posinf=0.0)
            label = f"load {curve.pressure / 1e6:.4g} MPa" if name == "temperature" else None
            axes.plot(speeds, values, color=colour, linestyle=style, linewidth=1.4, label=label)
            axes.fill_between(speeds, values - errors, values + errors, color=colour, alpha=0.2, linewidth=0)
    _speed_axis(axes, curves, scale.factor, scale.unit)
    axes.set_ylabel("temperature, °C")
    axes.axvline(scale.factor * abs(scene.motion.speed), color="0.35", linewidth=1, linestyle="--", zorder=0)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=6)
    return figure


def _speeds(curve: DynamicCurve, factor: float) -> Array:
    return np.array([point.speed for point in curve.points]) * factor


def _speed_axis(axes: Axes, curves: Sequence[DynamicCurve], factor: float, unit: str) -> None:
    """Label the axis of speeds, which is logarithmic over a wide range."""
    swept = [factor * point.speed for curve in curves for point in curve.points]
    if max(swept) > LOGARITHMIC_RATIO / 6 * min(swept):
        axes.set_xscale("log")
        plain_logarithmic(axes.xaxis)
    axes.set_xlabel(f"speed, {unit}")
