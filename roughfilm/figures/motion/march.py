"""Figures of marches: the orbit, film, pressure, load, power and flows over time, and a film over its plane."""

from itertools import cycle, product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from roughfilm.figures.shafts.angles import along_of
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.march.series import Snapshot
from roughfilm.rom.bearing.march.solve import March
from roughfilm.rom.bearing.scene import Bearing

COLOURS = ("#2166ac", "#b2182b", "#1a7f37", "#b07d2b", "#6a51a3")

BORE_SAMPLES = 361
"""Number of directions in which the room of the shaft is drawn."""

LEGEND_COLUMNS = 4
"""Columns of the legend of a panel."""

ROW = 0.13
"""Height of a row of a legend over the range of the values."""

FARTHEST = 2.0
"""Largest eccentricity at which the shaft is drawn to touch the bore."""

LINES = ("-", "--", ":")
"""Lines of the flows beyond the number of the colours."""

FLOW = 60e6
"""Flow in ml/min over that in m³/s."""


def orbit(march: March) -> Figure:
    """The path of the centre of the shaft over the clearance, in the room that the bore leaves it."""
    limit = room(march.placed)
    width, height = (float(np.nanmax(edge) - np.nanmin(edge)) for edge in limit)
    figure, axes = new_figure((8.4, min(max(0.6 + 4.6 * height / width, 2.4), 6.0)))
    x, y = march["eccentricity_x"], march["eccentricity_y"]
    late = march.time >= march.first
    axes.plot(*limit, color="#444444", linewidth=1.2, label="the shaft touches the bore")
    axes.plot(x, y, color="#9ab8d6", linewidth=0.8, label="all of the time")
    axes.plot(x[late], y[late], color=COLOURS[0], linewidth=1.6, label="the last part")
    least = int(np.argmin(np.where(late, march["film_min"], np.inf)))
    axes.plot(x[0], y[0], "o", color="#444444", markersize=4, label="start")
    axes.plot(x[least], y[least], "o", color=COLOURS[1], markersize=5, label="least film")
    if "inlet_angle" in march.quantities:
        inlet = np.radians(march.quantities["inlet_angle"].value)
        axes.plot(np.cos(inlet), np.sin(inlet), "s", color=COLOURS[2], markersize=6, label="inlet")
    axes.set(xlabel="x over the clearance", ylabel="y over the clearance", aspect="equal")
    axes.legend(fontsize=9, loc="center left", bbox_to_anchor=(1.02, 0.5))
    return figure


def room(scene: Bearing) -> tuple[Array, Array]:
    """The eccentricities at which the shaft touches the bore, in all directions; NaN beyond ``FARTHEST``."""
    geometry = scene.geometry
    assert isinstance(geometry, Lobes)
    low, high = np.zeros(BORE_SAMPLES), np.full(BORE_SAMPLES, FARTHEST)
    angles = np.linspace(0, 2 * np.pi, BORE_SAMPLES)
    for _ in range(24):
        middle = (low + high) / 2
        opens = geometry.least_films(middle * np.array([np.cos(angles), np.sin(angles)])) > 0
        low, high = np.where(opens, middle, low), np.where(opens, high, middle)
    low = np.where(high < FARTHEST, low, np.nan)
    return low * np.cos(angles), low * np.sin(angles)


def over_time(march: March) -> Figure:
    """Least film, pressures, load, power loss, flows and cavities over time, and of a pad its slopes and moments."""
    pivoted = "pivot_film" in march.series.units
    figure, panels = new_figure((11.4, 10.8 if pivoted else 8.2), 4 if pivoted else 3, 2, sharex=True)
    scale, unit = (1e3, "ms") if march.time[-1] < 1 else (1.0, "s")
    time = scale * march.time
    units = march.series.units
    film, pressure, load, power, flows, cavities, *others = panels.ravel()
    film.plot(time, 1e6 * march["film_min"], color=COLOURS[0])
    film.set(ylabel="least film, µm")
    pressure.plot(time, 1e-6 * march["pressure_max"], color=COLOURS[1])
    pressure.set(ylabel="peak pressure, MPa")
    fed = [name for name in units if name.startswith("supply") and name.endswith("_pressure")]
    for name, (line, colour) in zip(fed, cycle(product(LINES, (COLOURS[0], *COLOURS[2:]))), strict=False):
        label = f"in {name.removesuffix('_pressure').replace('_', ' ')}"
        pressure.plot(time, 1e-6 * march[name], color=colour, linestyle=line, linewidth=1.0, label=label)
    if fed:
        pressure.set(ylabel="pressure, MPa")
        pressure.lines[0].set_label("largest")
        _legend_above(pressure)
    forces = [name for name in units if name.startswith("load_force")]
    for name, colour in zip(forces, COLOURS, strict=False):
        part = name.removeprefix("load_force").replace("_", ", ")
        size = 1e-3 if part else -1e-3  # the load on a pad acts towards the sliding wall
        by_film = "minus film" if part else "film"
        load.plot(time, size * march[name], color=colour, label=f"load{part}")
        carried = -size * march[name.replace("load_", "film_")]
        load.plot(time, carried, color=colour, linestyle=":", label=f"{by_film}{part}")
    load.set(ylabel="force, kN" if units[forces[0]] == "N" else "force per width, kN/m")
    power.plot(time, march["power_loss"], color=COLOURS[0], label="all")
    power.plot(time, march["power_squeeze"], color=COLOURS[3], label="by squeezing")
    power.set(ylabel=f"power loss, {units['power_loss']}")
    wide = units["volume_rate"] == "m^2/s"
    through = [name for name in units if "_flow" in name and name != "flow_imbalance"]
    for name, (line, colour) in zip(through, cycle(product(LINES, COLOURS)), strict=False):
        label = name.replace("_flow", "").replace("_", " ")
        flows.plot(time, (1e6 if wide else FLOW) * march[name], color=colour, linestyle=line, label=label)
    flows.plot(time, (1e6 if wide else FLOW) * march["volume_rate"], color="#888888", linewidth=0.8, label="storage")
    flows.set(ylabel="flow, mm²/s" if wide else "flow, ml/min")
    cavities.plot(time, 100 * march["cavitated_fraction"], color=COLOURS[2])
    cavities.set(ylabel="cavitated, %", ylim=(0, max(1.0, cavities.get_ylim()[1])))
    if "temperature" in units:
        warm = cavities.twinx()
        warm.plot(time, march["temperature"], color=COLOURS[1])
        warm.set_ylabel("temperature of the film, °C", color=COLOURS[1])
        warm.grid(visible=False)
        warm.spines["right"].set_visible(True)
    if "contact_load" in units:
        load.plot(time, 1e-3 * march["contact_load"], color="#888888", linewidth=0.8, label="asperities")
    if pivoted:
        film.lines[0].set_label("least")
        film.plot(time, 1e6 * march["pivot_film"], color=COLOURS[3], label="at the pivot")
        film.set(ylabel="film, µm")
        _legend_above(film)
        _pad(march, time, *others)
    for axes in panels.ravel():
        _shade(axes, scale * march.first, scale * march.last)
    for axes in panels[-1]:
        axes.set(xlabel=f"time, {unit}")
    for axes in (load, power, flows):
        _legend_above(axes)
    return figure


def _pad(march: March, time: Array, slopes: Axes, moments: Axes) -> None:
    """The slopes of a pad about its pivot, and the moments on it."""
    units = march.series.units
    for along, moment, colour, name in (
        ("slope_x", "moment_y", COLOURS[0], "along"),
        ("slope_y", "moment_x", COLOURS[3], "across"),
    ):
        if along not in units:
            continue
        slopes.plot(time, 1e3 * march[along], color=colour, label=name)
        moments.plot(time, march[f"load_{moment}"], color=colour, label=f"load, about {moment[-1]}")
        moments.plot(
            time, -march[f"film_{moment}"], color=colour, linestyle=":", label=f"minus film, about {moment[-1]}"
        )
    slopes.set(ylabel="slope, mrad")
    moments.set(ylabel="moment, N m" if units["load_moment_y"] == "N*m" else "moment per width, N")
    for axes in (slopes, moments):
        _legend_above(axes)


def _legend_above(axes: Axes) -> None:
    """A legend above the lines of a panel."""
    low, high = axes.get_ylim()
    rows = -(-len(axes.get_legend_handles_labels()[1]) // LEGEND_COLUMNS)
    axes.set_ylim(low, high + (0.04 + ROW * rows) * (high - low))
    axes.legend(fontsize=8, ncols=LEGEND_COLUMNS, loc="upper right", borderaxespad=0.1, labelspacing=0.2)


def _shade(axes: Axes, first: float, last: float) -> None:
    axes.axvspan(first, last, color="black", alpha=0.05, zorder=-1)


def film(march: March, snapshot: Snapshot) -> Figure:
    """Pressure and film thickness over the unrolled film at one time."""
    figure, panels = new_figure((11.4, 3.6), 1, 2)
    axis, x, y = along_of(march.placed), march.series.grid["x"][0], 1e3 * march.series.grid["y"][0]
    along = axis(x)
    for axes, name, scale, title, map_ in (
        (panels[0], "pressure", 1e-6, "pressure above ambient, MPa", "magma"),
        (panels[1], "film_thickness", 1e6, "film thickness, µm", "cividis"),
    ):
        values = scale * snapshot.fields[name][0]
        axes.set(xlabel=axis.label)
        if y.size == 1:
            shown = axis.lobes_only(along, values[:, 0]) if name == "film_thickness" else values[:, 0]
            axes.plot(along, shown, color=COLOURS[0])
            axes.set(ylabel=title)
            axis.mark(axes, at=float(y[0]))
            continue
        axes.grid(visible=False)
        drawn = axes.pcolormesh(along, y, values.T, shading="gouraud", cmap=map_, rasterized=True)
        figure.colorbar(drawn, ax=axes, label=title)
        axes.set(ylabel="across, mm")
        cavity = (snapshot.fields["density_ratio"][0] < 1 - 1e-9).astype(float)
        if name == "pressure" and cavity.any():
            axes.contour(along, y, cavity.T, levels=[0.5], colors="white", linewidths=0.8, linestyles="--")
        axis.mark(axes, covered=True)
        axis.outline(axes)
    return figure
