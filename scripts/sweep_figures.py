"""The plots of a sweep: maps of error, errors against the number that orders them, errors against cost."""

from collections.abc import Mapping, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from rom.error_law import words
from rom.gap import Array
from rom.ordering import Ordering, product
from rom.sweep import Sweep, loaded, relative_error
from scripts.figures import TITLES, colour, marker, svg

LEAST_PERCENT = 1e-3


def shapes(sweep: Sweep) -> list[tuple[str, float]]:
    """The different (profile, shift) of a sweep, in order."""
    pairs = zip(sweep.given["profile"], sweep.given["shift_plus"], strict=True)
    return sorted({(str(profile), round(float(shift), 6)) for profile, shift in pairs})


def shape_name(shape: tuple[str, float]) -> str:
    """Profile, and how far its lowest point is shifted."""
    return shape[0] if shape[0] != "splined" else f"splined, xd+ = {shape[1]:g}"


def rows_of(sweep: Sweep, shape: tuple[str, float], reynolds_number: float | None = None) -> Array:
    """Which cases have this shape (and Reynolds number), shape (cases,), bool."""
    given = sweep.given
    chosen = (given["profile"] == shape[0]) & (np.abs(given["shift_plus"] - shape[1]) < 1e-6)
    if reynolds_number is not None:
        chosen &= np.isclose(given["reynolds_number"], reynolds_number)
    return np.asarray(chosen)


def error_maps(sweep: Sweep, setting: str, reference: str, quantity: str) -> str:
    """Error of one setting over (w+, d+), in per cent: a panel for each shape and Reynolds number."""
    numbers, kinds = np.unique(sweep.given["reynolds_number"]), shapes(sweep)
    error = 100 * relative_error(sweep, setting, reference, quantity)
    figure = Figure(figsize=(2.1 + 2.6 * numbers.size, 0.7 + 1.75 * len(kinds)), layout="constrained")
    panels = figure.subplots(len(kinds), numbers.size, squeeze=False)
    norm = LogNorm(vmin=0.05, vmax=50)
    image = mpl.cm.ScalarMappable(norm=norm, cmap="viridis_r")
    for line, shape in zip(panels, kinds, strict=True):
        for axes, number in zip(line, numbers, strict=True):
            rows = rows_of(sweep, shape, number)
            widths, depths = np.unique(sweep.given["width_plus"][rows]), np.unique(sweep.given["depth_plus"][rows])
            grid = np.full((depths.size, widths.size), np.nan)
            place = (
                np.searchsorted(depths, sweep.given["depth_plus"][rows]),
                np.searchsorted(widths, sweep.given["width_plus"][rows]),
            )
            grid[place] = error[rows]
            axes.grid(visible=False)
            axes.pcolormesh(np.maximum(grid, LEAST_PERCENT), norm=norm, cmap="viridis_r")
            for (i, j), value in np.ndenumerate(grid):
                if np.isfinite(value):
                    ink = "white" if value > 4 else "black"
                    axes.text(j + 0.5, i + 0.5, _short(value), ha="center", va="center", fontsize=6, color=ink)
            axes.set_xticks(np.arange(widths.size) + 0.5, [f"{w:g}" for w in widths], fontsize=7, rotation=60)
            axes.set_yticks(np.arange(depths.size) + 0.5, [f"{d:g}" for d in depths], fontsize=7)
            axes.set_title(f"{shape_name(shape)}, Re = {number:g}", fontsize=8)
    figure.supxlabel("groove width w+", fontsize=9)
    figure.supylabel("groove depth d+", fontsize=9)
    figure.colorbar(image, ax=panels, label=f"error in {TITLES[quantity]}, %", shrink=0.8)
    return svg(figure)


def errors_in_order(
    sweep: Sweep, reference: str, orderings: Mapping[tuple[str, str], Ordering], settings: Sequence[str]
) -> str:
    """Error against the number that orders it, a panel for each setting and quantity, with the thresholds."""
    figure = Figure(figsize=(10, 0.6 + 2.6 * len(settings)), layout="constrained")
    panels, told = figure.subplots(len(settings), len(TITLES), squeeze=False), set[tuple[str, float]]()
    for line, setting in zip(panels, settings, strict=True):
        for axes, (quantity, title) in zip(line, TITLES.items(), strict=True):
            if (setting, quantity) not in orderings:
                axes.set_axis_off()
                axes.set_title(f"{setting}: {title}, the same error everywhere", fontsize=9)
                continue
            found = orderings[setting, quantity]
            number = product(sweep.features(), found.powers)
            error = 100 * relative_error(sweep, setting, reference, quantity)
            error[~loaded(sweep, reference)] = np.nan
            for shape, sign in zip(shapes(sweep), "osD^v<>", strict=False):
                rows = rows_of(sweep, shape)
                label = None if shape in told else shape_name(shape)
                told.add(shape)
                axes.plot(number[rows], np.maximum(error[rows], LEAST_PERCENT), sign, ms=3, alpha=0.6, label=label)
            for tolerance, limit in found.thresholds.items():
                if limit is not None:
                    axes.plot([number.min(), limit, limit], [100 * tolerance] * 2 + [LEAST_PERCENT], "k:", lw=0.8)
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.set_title(f"{setting}: {title}, rank correlation {found.rank:.3f}", fontsize=9)
            axes.set_xlabel(words(found.powers), fontsize=8)
            axes.set_ylabel("error, %", fontsize=8)
    figure.legend(loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)


def sweep_chart(sweep: Sweep, reference: str, settings: Sequence[str]) -> str:
    """CPU seconds against error over all cases: a dot each, the median, and a bar up to 95 of 100 cases."""
    figure = Figure(figsize=(10, 4.6), layout="constrained")
    panels = figure.subplots(1, len(TITLES))
    for axes, (quantity, title) in zip(panels, TITLES.items(), strict=True):
        for setting in settings:
            error = np.maximum(100 * relative_error(sweep, setting, reference, quantity), LEAST_PERCENT)
            time = sweep.cpu_s[setting]
            known = np.isfinite(error) & np.isfinite(time) & loaded(sweep, reference)
            if not known.any():
                continue
            middle, high = np.percentile(error[known], [50, 95])
            axes.plot(time[known], error[known], ".", color=colour(setting), ms=2, alpha=0.25)
            axes.errorbar(
                np.median(time[known]),
                middle,
                [[0], [high - middle]],
                fmt=marker(setting),
                color=colour(setting),
                capsize=4,
                label=setting,
            )
        axes.axvline(
            np.nanmedian(sweep.cpu_s[reference]), color=colour(reference), ls=":", label=f"{reference} (reference)"
        )
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("CPU time a case, s")
        axes.set_ylabel(f"error in {title}, %")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=8)
    return svg(figure)


def _short(value: float) -> str:
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}" if value >= 0.1 else f"{value:.2f}".lstrip("0")
