"""Why seeds of a description differ from windows: what a spectrum and a height distribution do not contain."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.fitting.structure import (
    Line,
    flatness_of_tops,
    kurtosis_of_projections,
    strongest_line,
    surrogate,
)
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.fitting.quantities import NAMES, quantities_of
from roughfilm.sampling.plan import DECAY_LENGTHS, Group

RARE = 1e-3
"""Probability of a difference between windows and their copies of random phase below which it is stated."""

LEAST_RATIO = 1.15
"""Smallest ratio of medians that is stated."""

LEAST_SCATTER = 1.25
"""Smallest ratio of deviations of logarithms that is stated."""

LEAST_FLATNESS = 0.1
"""Smallest difference of the logarithms of slopes that is stated as plateaus."""

LINE_SHARE, LINE_STEADINESS = 0.25, 0.5
"""Smallest share of the power, and largest steadiness, of waves that count as periodic grooves."""

LEAST_TREND = 0.25
"""Smallest part of the variance between windows that a linear trend explains if it is stated."""

FLOOR = 1e-6
"""Ratio to the largest value at which a sealed direction enters a comparison of logarithms."""


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One property of the windows that a description has or lacks.

    Attributes
    ----------
    name : "grooves", "pressure", "valleys", "scatter", "scratches", "plateaus", "drift", "short"
        or "spread".
    text : a sentence with its numbers.
    lacking : whether seeds of the description lack it.
    """

    name: str
    text: str
    lacking: bool


@dataclass(frozen=True, kw_only=True)
class Structure:
    """Windows and their copies with the same spectra and heights and random phases.

    Attributes
    ----------
    line : the strongest waves.
    kurtosis : largest kurtosis of projections, of windows and of copies, shape (n, 2).
    angles : directions of these projections of the windows, degrees, shape (n,).
    flatness : flatness of the tops, of windows and of copies, shape (n, 2).
    copies : quantities of the copies, shape (n, 4).
    """

    line: Line
    kurtosis: Array
    angles: Array
    flatness: Array
    copies: Array

    __repr__ = brief


def structure_of(cells: Sequence[Surface], load: float, progress: Callable[[str], None]) -> Structure:
    """Compare windows with copies of random phase under a mean pressure over E*."""
    kurtosis, angles, flatness, copies = [], [], [], []
    for number, cell in enumerate(cells):
        progress(f"window {number + 1} of {len(cells)} with random phases")
        copy = surrogate(cell, number)
        projected = kurtosis_of_projections(cell)
        kurtosis.append((projected[0], kurtosis_of_projections(copy)[0]))
        angles.append(projected[1])
        flatness.append((flatness_of_tops(cell), flatness_of_tops(copy)))
        copies.append(quantities_of(copy, load))
    return Structure(
        line=strongest_line(cells),
        kurtosis=np.array(kurtosis),
        angles=np.array(angles),
        flatness=np.array(flatness),
        copies=np.array(copies),
    )


def findings_of(group: Group, windows: Array, structure: Structure, sal: float | None = None) -> tuple[Finding, ...]:
    """The findings on the windows of a surface, those that a description lacks first.

    Parameters
    ----------
    group : the windows.
    windows : their quantities, shape (n, 4).
    structure : their comparison with copies of random phase.
    sal : decay length Sal of the surface, m; None if it is unknown.
    """
    found = [
        *_grooves(structure.line, len(windows)),
        *_phases(windows, structure.copies),
        *_scratches(structure),
        *_plateaus(structure.flatness),
        *_drift(group),
        *_short(group.size, sal),
        *_spread(group.cells),
    ]
    return tuple(sorted(found, key=lambda one: not one.lacking))


def _grooves(line: Line, count: int) -> Iterator[Finding]:
    if line.share < LINE_SHARE or line.steadiness > LINE_STEADINESS:
        return
    locked = line.harmonic > 3 / math.sqrt(count)
    yield Finding(
        name="grooves",
        text=f"periodic grooves: waves of {1e6 * line.wavelength:.3g} µm along {line.angle:.0f}° have "
        f"{100 * line.share:.0f} % of the power, which varies between windows {1 / line.steadiness:.2g} times less "
        "than that of random waves"
        + (", and the phases of their harmonics are locked; random phases lose the shape of the grooves" * locked),
        lacking=True,
    )


def _phases(windows: Array, copies: Array) -> Iterator[Finding]:
    for k, name in enumerate(NAMES):
        if name == "mean gap":
            continue
        pair = np.column_stack([windows[:, k], copies[:, k]])
        pair = pair[np.isfinite(pair).all(axis=1)]
        if not pair.size or pair.max() <= 0:
            continue
        difference = np.diff(np.log(np.maximum(pair, FLOOR * pair.max())), axis=1)[:, 0]
        ratio = math.exp(float(np.median(difference)))
        if not _systematic(difference) or max(ratio, 1 / ratio) < LEAST_RATIO:
            yield from _scatter(name, np.log(np.maximum(pair, FLOOR * pair.max())))
            continue
        if k == 0:
            yield Finding(
                name="pressure",
                text="heights are correlated beyond the spectrum: with random phases but their own spectra and heights "
                f"the windows have {_times(ratio)} mean contact pressure (median), since "
                + f"their peaks are {'blunter' if ratio > 1 else 'sharper'} than random ones",
                lacking=True,
            )
        else:
            yield Finding(
                name="valleys",
                text=f"{'valleys are interrupted' if ratio > 1 else 'valleys are connected'} more than in a random "
                f"field: with random phases but their own spectra and heights the windows have {_times(ratio)} {name} "
                "(median)",
                lacking=True,
            )


def _scatter(name: str, logarithms: Array) -> Iterator[Finding]:
    """Whether windows scatter more than their copies (Brown and Forsythe)."""
    own, copies = logarithms.T
    if not copies.std() > 0:
        return
    ratio = float(own.std() / copies.std())
    if ratio > LEAST_SCATTER and scipy.stats.levene(own, copies, center="median").pvalue < RARE:
        yield Finding(
            name="scatter",
            text=f"the windows scatter {ratio:.2g} times as much in {name} as with random phases but their own spectra "
            "and heights",
            lacking=True,
        )


def _short(side: float, sal: float | None) -> Iterator[Finding]:
    if sal is None or side >= DECAY_LENGTHS * sal:
        return
    yield Finding(
        name="short",
        text=f"windows are {side / sal:.2g} decay lengths Sal long; below {DECAY_LENGTHS:g} a few valleys and the "
        "joint of the edges decide how much a window leaks",
        lacking=False,
    )


def _scratches(structure: Structure) -> Iterator[Finding]:
    logarithms = np.log(structure.kurtosis)
    difference = logarithms[:, 0] - logarithms[:, 1]
    ratio = math.exp(float(np.median(difference)))
    if _systematic(difference) and ratio > LEAST_RATIO:
        doubled = np.exp(2j * np.radians(structure.angles)).sum()
        yield Finding(
            name="scratches",
            text=f"straight scratches or ridges: heights projected along their direction, about "
            f"{math.degrees(math.atan2(doubled.imag, doubled.real)) / 2 % 180:.0f}°, have a kurtosis of "
            f"{np.median(structure.kurtosis[:, 0]):.2g}, random phases {np.median(structure.kurtosis[:, 1]):.2g}",
            lacking=True,
        )


def _plateaus(flatness: Array) -> Iterator[Finding]:
    difference = flatness[:, 0] - flatness[:, 1]
    size = float(np.median(difference))
    if not _systematic(difference) or abs(size) < LEAST_FLATNESS:
        return
    own, random = np.exp(np.median(flatness, axis=0))
    yield Finding(
        name="plateaus",
        text=("plateaus" if size > 0 else "steep tops")
        + f": the lower half of the heights is {own:.2g} times as steep as the upper half, {random:.2g} times with "
        "random phases and the same heights",
        lacking=True,
    )


def _drift(group: Group) -> Iterator[Finding]:
    if not group.windows:
        return
    rms = np.log([cell.heights.std() for cell in group.cells])
    places = np.array([window.start for window in group.windows], dtype=float)
    if len(rms) < 8:
        return
    matrix = np.column_stack([np.ones(len(rms)), places])
    matrix = matrix[:, [0, *(k + 1 for k in (0, 1) if np.ptp(places[:, k]) > 0)]]
    fitted = matrix @ np.linalg.lstsq(matrix, rms, rcond=None)[0]
    part = 1 - float(np.var(rms - fitted) / np.var(rms)) if np.var(rms) > 0 else 0.0
    worth = max(group.independent - matrix.shape[1], 1.0)
    steps = matrix.shape[1] - 1
    if steps and part > LEAST_TREND:
        by_chance = float(scipy.stats.f.sf(part / steps / ((1 - part) / worth), steps, worth))
        if by_chance < RARE:
            yield Finding(
                name="drift",
                text=f"the roughness drifts: a linear trend of the rms height over the measurement explains "
                f"{100 * part:.0f} % of its variance, from {1e6 * math.exp(fitted.min()):.3g} to "
                f"{1e6 * math.exp(fitted.max()):.3g} µm; seeds have its scatter, without a place",
                lacking=False,
            )


def _spread(cells: Sequence[Surface]) -> Iterator[Finding]:
    logarithms = np.log([cell.heights.std() for cell in cells])
    power = np.mean([np.abs(scipy.fft.fft2(c.heights - c.heights.mean(), norm="forward")) ** 2 for c in cells], axis=0)
    stationary = math.sqrt(float((power**2).sum()) / 2) / float(power.sum())
    yield Finding(
        name="spread",
        text=f"the rms height varies by {100 * logarithms.std():.0f} % between windows, that of a stationary Gaussian "
        f"field of their spectrum by {100 * stationary:.0f} %",
        lacking=False,
    )


def _systematic(difference: Array) -> bool:
    """Whether paired differences are not of either sign by chance (signed ranks of Wilcoxon)."""
    if len(difference) < 8 or not np.any(difference):
        return False
    return bool(scipy.stats.wilcoxon(difference).pvalue < RARE)


def _times(ratio: float) -> str:
    return f"{ratio:.2g} times the"
