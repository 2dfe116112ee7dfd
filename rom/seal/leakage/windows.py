"""Leakage of a seal whose surface is known in several windows: each window on its own, and their mean."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import scipy

from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.store import load_contact
from roughfilm.contact.windows.average import WindowAverage, window_average
from roughfilm.rom.ladder.model import silent
from roughfilm.rom.seal.at_load import SealAtLoad, seal_at_load
from roughfilm.rom.seal.leakage.curve import chosen_loads, seal_setup, sealing, solved
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.series import SOUGHT, UNITS, Row
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal

AVERAGED = ("area_fraction", "plastic_fraction", "mean_gap", "valley_depth")
"""Names of the numbers of a row, beside the permeabilities, whose mean over the windows is taken."""


@dataclass(frozen=True, kw_only=True)
class SealWindow:
    """The leakage of one window over the loads.

    Attributes
    ----------
    rows : contact and flow by load, Pa.
    thresholds : sealing loads by the names in ``SOUGHT``.
    answer : the seal of this window at one load.
    known : number of rows that were known before.
    """

    rows: Mapping[float, Row]
    thresholds: Mapping[str, Threshold]
    answer: SealAtLoad
    known: int


@dataclass(frozen=True, kw_only=True)
class SealingLoads:
    """The loads at which the windows seal in one direction.

    Attributes
    ----------
    sealing : fraction of the windows that seal at a load that the solids can carry.
    always : fraction of the windows that are sealed at every load; their sealing load is 0.
    load, area_fraction : load, Pa, and contact area fraction; None unless every window seals.
    """

    sealing: float
    always: float
    load: WindowAverage | None
    area_fraction: WindowAverage | None


@dataclass(frozen=True, kw_only=True)
class SealOfWindows:
    """The leakage of a seal that is as wide as very many windows.

    Windows beside each other across the flow add their leakage, so that the permeability of the seal is the arithmetic
    mean. Along the flow there are ``periods`` windows in series. If the liquid is free to move sideways between them,
    the mean holds for each; if it is not, it passes them in lanes, whose permeability is the harmonic mean of their
    windows. The seal is between these limits: the mean is the upper one, ``in_series`` the lower one, and the
    confidence interval of each permeability reaches down to it.

    Attributes
    ----------
    loads : mean pressures, Pa.
    numbers : by the names in ``AVERAGED`` and ``SOUGHT``, the mean over the windows at each load, in SI units.
    peaks : largest pressure of all windows at each load, Pa.
    in_series : by the names in ``SOUGHT``, the mean permeability of lanes at each load, m³.
    sealing : by the names in ``SOUGHT``, the sealing loads.
    answer : at one load ``leakage_per_width``, kg/(s m), of the whole length, ``area_fraction`` and ``mean_gap``, m.
    answer_in_series : the leakage per width of lanes at that load, kg/(s m).
    load : that load, Pa.
    periods : by axis, the number of windows along the flow.
    count : number of windows.
    independent : effective number of independent windows.
    """

    loads: tuple[float, ...]
    numbers: Mapping[str, tuple[WindowAverage, ...]]
    peaks: tuple[float, ...]
    in_series: Mapping[str, tuple[float, ...]]
    sealing: Mapping[str, SealingLoads]
    answer: Mapping[str, WindowAverage]
    answer_in_series: float
    load: float
    periods: tuple[int, int]
    count: int
    independent: float


def window_thresholds(scene: Seal, directory: Path) -> dict[str, Threshold]:
    """The sealing thresholds of a window, from its directory or computed."""
    return sealing(seal_setup(scene, directory), silent)


def common_loads(scene: Seal, directory: Path, thresholds: Sequence[Mapping[str, Threshold]]) -> tuple[float, ...]:
    """The loads of all windows, Pa: the default ones of the first window, up to where the last window seals.

    Parameters
    ----------
    scene, directory : the seal with the surface of the first window, and the directory of its files.
    thresholds : sealing thresholds of each window.
    """
    last = {name: max((own[name] for own in thresholds), key=_by_sealing) for name in SOUGHT}
    return chosen_loads(seal_setup(scene, directory), last)


def window_leakage(scene: Seal, directory: Path, loads: tuple[float, ...], load: float, threads: int) -> SealWindow:
    """The leakage of a window at some loads; finished loads are kept in its directory.

    Parameters
    ----------
    scene : the seal with the surface of the window.
    directory : directory of its files; the contact is kept at the one load.
    loads : mean pressures, Pa.
    load : one of them, at which the whole seal is solved, Pa.
    threads : number of gaps whose flow is solved at the same time.

    Raises
    ------
    InputError
        If a file was damaged, holds other data or cannot be written.
    ConvergenceError
        If the contact at a load does not converge.
    """
    body = replace(seal_setup(scene, directory), stored_loads=(load,))
    found = sealing(body, silent)
    rows, known = solved(body, loads, threads, silent)
    answer = seal_at_load(scene, load_contact(body.contacts, load))
    return SealWindow(rows=rows, thresholds=found, answer=answer, known=known)


def seal_of_windows(
    scene: Seal, windows: Sequence[SealWindow], size: tuple[float, float], independent: float
) -> SealOfWindows:
    """The leakage of a seal from that of its windows at common loads.

    Parameters
    ----------
    scene : the seal.
    windows : one or more windows with the same loads.
    size : length of a window along x and y, m.
    independent : effective number of independent windows.
    """
    loads = tuple(windows[0].rows)
    periods = tuple(max(1, round(scene.flow.length / length)) for length in size)
    numbers: dict[str, list[WindowAverage]] = {name: [] for name in (*AVERAGED, *SOUGHT)}
    in_series: dict[str, list[float]] = {name: [] for name in SOUGHT}
    for load in loads:
        rows = [window.rows[load] for window in windows]
        for name in AVERAGED:
            values = [getattr(row, name) for row in rows]
            numbers[name].append(_average(values, [], independent))
        for number, name in enumerate(SOUGHT):
            values = [getattr(row, name) for row in rows]
            uncertainties = [getattr(row, f"{name}_uncertainty") for row in rows]
            found, lanes = _permeability(values, uncertainties, independent, periods[number % 2])
            numbers[name].append(found)
            in_series[name].append(lanes)
    answers = [window.answer for window in windows]
    leak, lanes = _permeability(
        [one.leakage_per_width.value for one in answers],
        [one.leakage_per_width.uncertainty for one in answers],
        independent,
        answers[0].periods,
    )
    quantities: dict[str, WindowAverage] = {"leakage_per_width": leak}
    for name in ("area_fraction", "mean_gap"):
        parts: list[Quantity] = [getattr(one, name) for one in answers]
        quantities[name] = _average([one.value for one in parts], [one.uncertainty for one in parts], independent)
    return SealOfWindows(
        loads=loads,
        numbers={name: tuple(column) for name, column in numbers.items()},
        peaks=tuple(max(window.rows[load].pressure_max for window in windows) for load in loads),
        in_series={name: tuple(column) for name, column in in_series.items()},
        sealing={name: _sealing([one.thresholds[name] for one in windows], independent) for name in SOUGHT},
        answer=quantities,
        answer_in_series=lanes,
        load=answers[0].load,
        periods=(periods[0], periods[1]),
        count=len(windows),
        independent=independent,
    )


def columns_of_windows(scene: Seal, seal: SealOfWindows) -> dict[str, tuple[str, list[float]]]:
    """The units and values, by name, of the columns of a table with a row for each load.

    Each number has columns with its scatter and the ends of the interval for one window; a permeability also its
    numerical uncertainty, the fraction of sealed windows, and the lower limit for windows in series. The
    largest pressure is that of all windows.
    """
    columns: dict[str, tuple[str, list[float]]] = {
        "load": ("Pa", [*seal.loads]),
        "pressure_max": ("Pa", [*seal.peaks]),
    }

    def add(name: str, unit: str, values: Sequence[float]) -> None:
        columns[name] = unit, [*values]

    def add_average(name: str, unit: str, averages: Sequence[WindowAverage]) -> None:
        for key in averages[0].columns(name):
            add(key, unit, [one.columns(name)[key] for one in averages])

    for name in (*AVERAGED, *SOUGHT):
        add_average(name, UNITS.get(name, "1"), seal.numbers[name])
    for name in SOUGHT:
        unknown = [math.nan if one.uncertainty is None else one.uncertainty for one in seal.numbers[name]]
        add(f"{name}_uncertainty", UNITS[name], unknown)
        add(f"{name}_sealed", "1", [one.zeros for one in seal.numbers[name]])
        add(f"{name}_in_series", UNITS[name], seal.in_series[name])
        factor = leakage_of(scene, 1.0)
        add_average(f"leakage_{name}", "kg/(m*s)", [one.scaled(factor) for one in seal.numbers[name]])
    return columns


def permeability_in_series(values: Sequence[float], periods: int) -> float:
    """The expected harmonic mean of n permeabilities that are drawn at random from those of the windows, m³.

    With the resistances R = 1/K it is n ∫₀^∞ <exp(-t R)>ⁿ dt, where < > is the mean over the windows; a sealed window
    has an infinite resistance. It is the arithmetic mean for n = 1, and the harmonic one of all windows for large n.

    Parameters
    ----------
    values : permeability of each window, m³, 0 if it is sealed.
    periods : n, 1 or more.

    Examples
    --------
    >>> [round(permeability_in_series([1.0, 4.0], n), 3) for n in (1, 2, 1000)]
    [2.5, 2.05, 1.601]
    """
    k = np.asarray(values, dtype=float)
    flowing = k[k > 0]
    if periods == 1 or not flowing.size or np.ptp(k) == 0:
        return float(k.mean())
    scale = float(flowing.max())
    resistances = scale / flowing
    logarithm = scipy.special.logsumexp
    weight = math.log(k.size)
    # Over u = ln t the integrand is smooth and falls off at both ends.
    longest = math.log(750.0 / periods)
    u = np.linspace(min(longest, 0.0) - 45.0, longest, 6001)
    exponents = logarithm(-np.exp(u)[:, None] * resistances, axis=1) - weight
    integrand = np.exp(periods * exponents + u)
    return scale * periods * float(scipy.integrate.simpson(integrand, x=u))


def _permeability(
    values: Sequence[float], uncertainties: Sequence[float | None], independent: float, periods: int
) -> tuple[WindowAverage, float]:
    """The mean permeability with the effect of windows in series in its scatter, and the mean of lanes."""
    lanes = permeability_in_series(values, periods)
    return _average(values, uncertainties, independent).above(lanes), lanes


def _average(values: Sequence[float], uncertainties: Sequence[float | None], independent: float) -> WindowAverage:
    """The mean over the windows; NaN with an unknown scatter if a window has no value."""
    if not np.isfinite(values).all():
        unknown = np.asarray(values, dtype=float)
        return WindowAverage(
            values=unknown, value=math.nan, uncertainty=None, mean_interval=None, interval=None, zeros=0.0
        )
    return window_average(values, uncertainties, independent=independent)


def _by_sealing(threshold: Threshold) -> float:
    return math.inf if threshold.sealed is None else threshold.sealed.load


def _sealing(thresholds: Sequence[Threshold], independent: float) -> SealingLoads:
    finite = all(one.sealed is not None for one in thresholds)
    load, area = (
        window_average(
            [getattr(one, name) for one in thresholds],
            [_half_width(one, name) for one in thresholds],
            independent=independent,
        )
        if finite
        else None
        for name in ("load", "area_fraction")
    )
    return SealingLoads(
        sealing=float(np.mean([one.sealed is not None for one in thresholds])),
        always=float(np.mean([one.open is None for one in thresholds])),
        load=load,
        area_fraction=area,
    )


def _half_width(threshold: Threshold, name: str) -> float:
    """Half the width of a bracket; 0 if the window is sealed at every load."""
    if threshold.open is None or threshold.sealed is None:
        return 0.0
    return 0.5 * abs(float(getattr(threshold.sealed, name)) - float(getattr(threshold.open, name)))
