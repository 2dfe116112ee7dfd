"""Pressure of the Reynolds equation with first-order inertia over one period of a gap, by Gauss quadrature."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket import closed_form as film_flow
from roughfilm.rom.pocket.piecewise import GaussRule, extrema, gauss_rule
from roughfilm.rom.thin_film.gap import Gap

NODES = 24
"""Number of Gauss points on each smooth piece of the gap, by default."""


@dataclass(frozen=True, kw_only=True)
class Film:
    """The gap h at the nodes x, shape (pieces, nodes), and half the length of each piece, in film thicknesses."""

    x: Array
    h: Array
    half: Array


def sample(gap: Gap, nodes: Array) -> Film:
    """The film at nodes in -1 .. 1 on each smooth piece of the gap, in film thicknesses."""
    ends = np.array(gap.pieces)
    middle, half = ends.mean(axis=1, keepdims=True), np.diff(ends, axis=1) / 2
    x = middle + half * nodes
    return Film(x=x / gap.film, h=gap.thickness(x) / gap.film, half=half / gap.film)


def flow_and_residual(gap: Gap, film: Film, rule: GaussRule) -> tuple[float, float]:
    """The flow of periodic pressure, and the relative error of the interpolated gradient between the nodes."""
    weights = film.half * rule.weights
    q = float((weights / film.h**2).sum() / (2 * (weights / film.h**3).sum()))
    between = sample(gap, rule.check_nodes)
    exact = film_flow.pressure_gradient(between.h, q)
    interpolated = film_flow.pressure_gradient(film.h, q) @ rule.check.T
    check_weights = between.half * rule.check_weights
    mismatch = (check_weights * np.abs(interpolated - exact)).sum()
    return q, float(mismatch / (check_weights * np.abs(exact)).sum())


def mean(film: Film, rule: GaussRule, values: Array) -> float:
    """The mean over the period of values at the nodes, shape (pieces, nodes)."""
    return float((film.half * rule.weights * values).sum() / (2 * film.half.sum()))


@dataclass(frozen=True, kw_only=True)
class FilmPressure:
    """Pressure at the nodes, shape (pieces, nodes), its mean and its extremes."""

    pressure: Array
    load: float
    lowest: float
    highest: float


def film_pressure(gap: Gap, film: Film, rule: GaussRule, q: float, reynolds_number: float) -> FilmPressure:
    """The pressure of the Reynolds equation with inertia to first order in the Reynolds number."""
    gradient = film_flow.pressure_gradient(film.h, q)
    across = film.half * (gradient @ rule.weights)[:, None]
    start = np.vstack([[0.0], np.cumsum(across)[:-1, None]])
    pressure = start + film.half * (gradient @ rule.primitive.T)
    ends = start.ravel()  # pressure at the left end of every piece
    if reynolds_number:
        ends = ends + reynolds_number * film_flow.inertia_pressure(
            gap.thickness(np.array(gap.breaks[:-1])) / gap.film, q
        )
        pressure = pressure + reynolds_number * film_flow.inertia_pressure(film.h, q)
        slope = (film.h @ rule.derivative.T) / film.half
        gradient = gradient + reynolds_number * film_flow.inertia_pressure_gradient(film.h, slope, q)
    lowest, highest = extrema(film.x, pressure, gradient)
    return FilmPressure(
        pressure=pressure,
        load=mean(film, rule, pressure),
        lowest=min(lowest, float(ends.min())),
        highest=max(highest, float(ends.max())),
    )


def load_over_pressure(gap: Gap, reynolds_number: float) -> float:
    """The magnitude of the mean pressure over the largest pressure, with inertia to first order in ``reynolds_number``.

    The default number of nodes is used; the result is NaN for a film without pressure.
    """
    rule = gauss_rule(NODES)
    film = sample(gap, rule.nodes)
    q, _ = flow_and_residual(gap, film, rule)
    flow = film_pressure(gap, film, rule, q, reynolds_number)
    return abs(flow.load) / max(abs(flow.lowest), abs(flow.highest))
