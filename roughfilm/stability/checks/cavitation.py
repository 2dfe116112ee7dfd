"""The balance of flows of a film, recomputed by NumPy from the film thickness and the state without solver code."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution

GAUSS = (0.5 - 0.5 / math.sqrt(3), 0.5 + 0.5 / math.sqrt(3))
"""Gauss points of an interval, as fractions of its length."""


QUARTER = 0.25
"""Part of a face after which a film may rupture, and after two and three of it."""


def broken_balance(solution: Solution) -> float:
    """The largest net flow into a node of free state, over the largest flow; infinite if the state is impossible.

    A state is possible if p >= 0, 0 <= ξ <= 1, ξ = 1 where p > 0, and ends and sides have their given pressures. The
    net flow into a full inlet node may be smaller than the supply, but not larger.
    """
    problem, x, y = solution.problem, solution.grid.x, solution.grid.y
    pressure, fill = solution.state.pressure, solution.state.fill
    shape, ends = problem.shape, problem.ends
    if not (np.isfinite(pressure).all() and np.isfinite(fill).all()):
        return math.inf
    if pressure.min() < 0 or fill.min() < 0 or fill.max() > 1 or (fill[pressure > 0] < 1).any():
        return math.inf
    free, wanted = np.ones(pressure.shape, dtype=bool), pressure.copy()
    given: list[tuple[tuple[slice, slice], float]] = []
    if not shape.joined[0]:
        given.append((np.s_[-1:, :], ends.outlet))
        if ends.inlet is not None:
            given.append((np.s_[:1, :], ends.inlet))
    if ends.sides is not None:
        given += [(np.s_[:, :1], ends.sides[0]), (np.s_[:, -1:], ends.sides[1])]
    for place, value in given:
        free[place], wanted[place] = False, value
    if (np.abs(pressure - wanted) > 0).any():
        return math.inf
    along, across = _flows(problem, x, y, pressure, fill)
    net = along - np.roll(along, 1, axis=0) + across - np.roll(across, 1, axis=1)
    if ends.inlet is None and not shape.joined[0]:
        drag = problem.speed / 2 * _widths(problem, y) * _radius(problem, y)
        supply = drag * ends.theta * shape.thickness(np.full_like(y, x[0]), y)
        net[0] = along[0] - supply
        net[0] = np.where(fill[0] < 1, net[0], np.maximum(net[0], 0.0))
    largest = max(float(np.abs(along).max()), float(np.abs(across).max()))
    return float(np.abs(net[free]).max()) / largest if largest > 0 and free.any() else 0.0


def _flows(problem: Problem, x: Array, y: Array, pressure: Array, fill: Array) -> tuple[Array, Array]:
    """The flows from each node to the next one in x and in y, m³/s at p = 0; zero where there is no next node."""
    shape = problem.shape
    radius, widths = _radius(problem, y), _widths(problem, y)
    excess = problem.compression(pressure)[0]
    slope = float(problem.compression(np.zeros(1))[1][0])
    mobility = problem.mobility(pressure)[0]
    faces = x.size if shape.joined[0] else x.size - 1
    step = (np.append(np.diff(x), shape.breaks[-1] - x[-1]) if shape.joined[0] else np.diff(x))[:, None]
    rise = (np.roll(pressure, -1, axis=0) - pressure)[:faces]
    mean, cube = np.zeros((faces, y.size)), np.zeros((faces, y.size))
    lowest = y[0] - (shape.across[1] - y[-1]) / 2 if shape.joined[1] else y[0]
    begins = np.append(lowest, (y[:-1] + y[1:]) / 2)
    strips = [y] if shape.wide else [begins + part * widths for part in (0.25, 0.75)]
    for strip in strips:
        h = [shape.thickness(*np.broadcast_arrays(x[:faces, None] + g * step, strip)) for g in GAUSS]
        cubed = h[0] ** -3.0 + h[1] ** -3.0
        mean += (h[0] ** -2.0 + h[1] ** -2.0) / cubed / len(strips)
        cube += 2 / cubed / len(strips)
    carried = problem.speed / 2 * widths * radius * mean
    conductance = cube * widths / (12 * problem.viscosity * radius * step)
    with np.errstate(divide="ignore", invalid="ignore"):
        upstream = np.where(carried * slope > 0, np.maximum(0.5, 1 - conductance / (carried * slope)), 0.5)
    ahead = np.roll(excess, -1, axis=0)[:faces]
    phi = _between(mobility, np.roll(mobility, -1, axis=0))[:faces]
    density = fill[:faces] + upstream * excess[:faces] + (1 - upstream) * ahead
    along = np.zeros(pressure.shape)
    along[:faces] = carried * density - conductance * phi * rise
    begun = _between(mobility, np.ones_like(mobility))[:faces] * pressure[:faces]
    filled = fill[:faces] + upstream * excess[:faces]
    for number in (1, 2, 3):  # a film that ruptures inside the face carries the least of them
        mean, cube = np.zeros((faces, y.size)), np.zeros((faces, y.size))
        for strip in strips:
            places = [x[:faces, None] + (quarter + 0.5) * QUARTER * step for quarter in range(number)]
            h = [shape.thickness(*np.broadcast_arrays(place, strip)) for place in places]
            cubed = np.sum([one**-3.0 for one in h], axis=0)
            mean += np.sum([one**-2.0 for one in h], axis=0) / cubed / len(strips)
            cube += 1 / (QUARTER * cubed) / len(strips)
        ruptured = problem.speed / 2 * widths * radius * mean * filled
        ruptured += cube * widths / (12 * problem.viscosity * radius * step) * begun
        along[:faces] = np.minimum(along[:faces], ruptured)
    across = np.zeros(pressure.shape)
    if y.size > 1:
        lengths = control_lengths(x, shape.breaks[-1] - x[0] if shape.joined[0] else None)[:, None]
        width = np.diff(y)
        rows = slice(1 if problem.ends.inlet is None and not shape.joined[0] else 0, None)
        before = np.append(step[-1] if shape.joined[0] else [[0.0]], step)[: x.size]
        after = np.append(step, 0.0)[: x.size]
        for part in (-0.25 * before, 0.25 * after):
            place = (x + part)[:, None]
            h = [shape.thickness(*np.broadcast_arrays(place, y[:-1] + g * width)) for g in GAUSS]
            cubed = 2 / (h[0] ** -3.0 + h[1] ** -3.0) / 2
            middle = (radius[:-1] + radius[1:]) / 2
            conductance = cubed * lengths * middle / (12 * problem.viscosity * width)
            flow = -conductance * _between(mobility[:, :-1], mobility[:, 1:]) * np.diff(pressure, axis=1)
            across[rows, :-1] += flow[rows]
    return along, across


def _between(first: Array, second: Array) -> Array:
    """The mean of φ between two pressures if φ is exponential in p: the integral of a^(1-s) b^s over s from 0 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    s = (1 + nodes)[:, None, None] / 2
    return np.asarray((weights[:, None, None] / 2 * first ** (1 - s) * second**s).sum(axis=0))


def _radius(problem: Problem, y: Array) -> Array:
    return y if problem.shape.polar else np.ones_like(y)


def _widths(problem: Problem, y: Array) -> Array:
    """The widths of the control volumes, m; 1 for an infinitely wide film."""
    shape = problem.shape
    return np.ones(1) if shape.wide else control_lengths(y, shape.across[1] - y[0] if shape.joined[1] else None)


def control_lengths(places: Array, period: float | None) -> Array:
    """The lengths of the control volumes of nodes on a line, shape (n,).

    Parameters
    ----------
    places : coordinates of the nodes, shape (n,).
    period : period of the line in the unit of ``places``, None for a line with two ends.
    """
    before = np.diff(places, prepend=places[0] if period is None else places[-1] - period)
    after = np.diff(places, append=places[-1] if period is None else places[0] + period)
    return np.asarray((before + after) / 2)
