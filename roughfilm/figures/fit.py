"""Figures of a fitted description: windows beside seeds, their spectra, bearing curves and quantities."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.parameters.bearing_curve import bearing_curve
from roughfilm.contact.parameters.spectrum import power_spectrum, radial_power
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.figures.base import new_figure, surface_map, svg
from roughfilm.figures.ticks import plain_logarithmic, whole_decades
from roughfilm.fitting.judge import Held
from roughfilm.fitting.quantities import NAMES
from roughfilm.fitting.run import Fit
from roughfilm.words.fit import titled

WINDOWS, SEEDS = "#e08214", "#2166ac"
"""Colours of windows and of seeds."""

SHOWN = 5
"""Number of windows and of seeds that are drawn as maps."""

BAND = (5, 50, 95)
"""Percentiles of a band and its middle."""

LEAST_POWER = 1e-9
"""Smallest power over the largest that is drawn."""

FEW_DECADES = 30.0
"""Largest ratio of the ends of an axis with plain numbers."""

FACTORS = (1.0, 1e6, 1e18, 1e18)
"""Factors from SI units to those of the titles of the quantities."""


def maps(fit: Fit) -> str:
    """Windows above, seeds below, in the same colours."""
    cells = fit.group.cells
    chosen = [cells[round(k)] for k in np.linspace(0, len(cells) - 1, SHOWN)]
    drawn = [*chosen, *fit.surfaces[:SHOWN]]
    limit = 1e6 * float(np.percentile([np.percentile(np.abs(_centred(one)), 99.5) for one in drawn], 75))
    aspect = cells[0].size[1] / cells[0].size[0]
    figure, panels = new_figure((11, 1.2 + 2 * min(max(2.0 * aspect, 0.8), 3.2)), 2, SHOWN)
    for number, (surface, axes) in enumerate(zip(drawn, panels.ravel(), strict=True)):
        image = surface_map(axes, 1e6 * _centred(surface), surface.size, cmap="RdBu_r", vmin=-limit, vmax=limit)
        first = number % SHOWN == 0
        axes.set(
            xlabel="x, µm" if number >= SHOWN else "",
            ylabel=f"{'windows' if number < SHOWN else 'seeds'}\ny, µm" if first else "",
        )
    figure.colorbar(image, ax=panels.ravel().tolist(), label="height, µm", shrink=0.9)
    return svg(figure)


def spectra(fit: Fit) -> str:
    """Power by wavelength over all directions, and across and along the rows: bands of windows and of seeds."""
    figure, axes = new_figure((5.4, 4.2))
    for surfaces, label, colour in _both(fit):
        frequency, power = _radial(surfaces)
        low, middle, high = np.percentile(power, BAND, axis=0)
        some = middle > LEAST_POWER * middle.max()
        wavelength = 1e6 / frequency[some]
        axes.fill_between(wavelength, 1e12 * low[some], 1e12 * high[some], color=colour, alpha=0.25, linewidth=0)
        axes.loglog(wavelength, 1e12 * middle[some], color=colour, label=label)
    axes.invert_xaxis()
    axes.set(xlabel="wavelength, µm", ylabel="mean square height per octave, µm²")
    plain_logarithmic(axes.xaxis)
    figure.legend(loc="outside upper center", ncols=2)
    return svg(figure)


def bearing_curves(fit: Fit) -> str:
    """Height over the part of the surface above it: bands of windows and of seeds."""
    figure, axes = new_figure((5.4, 4.2))
    ratio = np.linspace(0.001, 0.999, 200)
    for surfaces, label, colour in _both(fit):
        curves = []
        for one in surfaces:
            part, height = bearing_curve(_centred(one))
            curves.append(np.interp(ratio, part, height))
        low, middle, high = 1e6 * np.percentile(curves, BAND, axis=0)
        axes.fill_between(100 * ratio, low, high, color=colour, alpha=0.25, linewidth=0)
        axes.plot(100 * ratio, middle, color=colour, label=label)
    axes.set(xlabel="part of the surface above, %", ylabel="height, µm")
    figure.legend(loc="outside upper center", ncols=2)
    return svg(figure)


def quantities(fit: Fit) -> str:
    """Each quantity of windows and seeds, and the interval of the seeds of the halves."""
    figure, panels = new_figure((11, 5.4), 2, 2)
    for k, (name, axes) in enumerate(zip(NAMES, panels.ravel(), strict=True)):
        _strip(axes, fit.held[name], fit.windows[:, k] * FACTORS[k], fit.seeds[:, k] * FACTORS[k], FACTORS[k])
        axes.set_xlabel(titled(name))
    return svg(figure)


def _strip(axes: Axes, held: Held, windows: Array, seeds: Array, factor: float) -> None:
    known = [values[np.isfinite(values)] for values in (windows, seeds)]
    positive = np.concatenate([values[values > 0] for values in known])
    least = positive.min() / 3 if positive.size else 1.0
    axes.set_xscale("log")
    low, high = (max(factor * end, least) for end in held.interval)
    axes.axvspan(low, high, color="0.9", zorder=-2)
    for row, (values, colour) in enumerate(zip(known, (WINDOWS, SEEDS), strict=True)):
        height = row + 0.6 * (np.arange(values.size) / max(values.size - 1, 1) - 0.5)
        open_ = values > 0
        axes.plot(values[open_], height[open_], ".", color=colour, markersize=4)
        sealed = int((~open_).sum())
        if sealed:
            axes.plot(np.full(sealed, least), height[~open_], "x", color=colour, markersize=4)
    left, right = axes.get_xlim()
    (plain_logarithmic if right < FEW_DECADES * left else whole_decades)(axes.xaxis)
    axes.set_yticks([0, 1], ["windows", "seeds"])
    axes.set_ylim(1.5, -0.5)


def _both(fit: Fit) -> tuple[tuple[Sequence[Surface], str, str], ...]:
    return (fit.group.cells, "windows", WINDOWS), (fit.surfaces, "seeds", SEEDS)


def _centred(surface: Surface) -> Array:
    return np.asarray(surface.heights - surface.heights.mean())


def _radial(surfaces: Sequence[Surface]) -> tuple[Array, Array]:
    """Frequencies, 1/m, and power per octave of each surface in quarters of an octave, shape (surfaces, n)."""
    rows = []
    for one in surfaces:
        frequency, power = radial_power(power_spectrum(one))
        quarter = np.rint(4 * np.log2(frequency[1:] / frequency[1])).astype(int)
        rows.append(4 * np.bincount(quarter, weights=power[1:]))
    numbers = np.unique(quarter)
    return np.asarray(frequency[1] * 2.0 ** (numbers / 4)), np.array(rows, dtype=float)[:, numbers]
