"""Newton's method for the thin-film equations, with continuation in the Reynolds number if needed."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.thin_film import slope, thin_film
from roughfilm.rom.thin_film.basis import Basis, gauss_basis
from roughfilm.rom.thin_film.continuation import continued
from roughfilm.rom.thin_film.thin_film import Strip, StripFlow

MODES = 10
"""Polynomials across the film; with 16 load changes by at most 3e-5 and friction by 3e-4 in 120 published cases."""

NEWTON_STEPS = 12
"""Largest number of Newton steps at one Reynolds number."""

MAX_LAST_MODE = 0.1
"""Largest last amplitude over the largest one at which the velocity across the film is resolved."""


@dataclass(frozen=True, kw_only=True)
class ThinFilm:
    """A solution of the thin-film equations.

    Attributes
    ----------
    state : the flow.
    uncorrected : the flow without the correction for slope, from which a search on another grid may start.
    pressure : pressure on the sliding wall at the faces above that at the first one, shape (cells + 1,).
    residual : largest imbalance of momentum in a cell, relative to the largest force in one.
    steps : number of Newton steps.
    """

    state: StripFlow
    uncorrected: StripFlow
    pressure: Array
    residual: float
    steps: int


def solve(
    film: Strip,
    reynolds_number: float,
    *,
    tolerance: float,
    with_slope: bool,
    progress: Progress = silent,
    start: StripFlow | None = None,
) -> ThinFilm:
    """Solve the thin-film Navier-Stokes equations on the cells of a gap, with slope to second order if asked for.

    The correction for slope (:mod:`roughfilm.rom.thin_film.slope`) is the linear response of the film to the neglected
    forces. The error is of second order in the cell size (of first order without second-order reconstruction), and
    spectral across the film.

    Parameters
    ----------
    film : the cells.
    reynolds_number : Re = ρ u Ly/η with the unit of length Ly.
    tolerance : residual at which Newton's method stops.
    with_slope : whether the flow is corrected for slope.
    progress : called with the done fraction and a few words.
    start : a flow on the same cells from which the search starts; by default that without inertia.

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge to the tolerance.
    """
    across = gauss_basis(MODES)
    with np.errstate(all="ignore"):
        found, linear, steps = continued(
            lambda at, state: _newton(film, across, at, state, tolerance),
            thin_film.creeping(film, MODES),
            reynolds_number,
            progress,
            start=start,
        )
        residual, rise = _residual(film, across, linear), thin_film.pressure_rise(film, across, linear.imbalance)
        state = found
        if with_slope:
            state, rise = _with_slope(film, across, reynolds_number, found, linear, rise)
    pressure = np.concatenate([[0.0], np.cumsum(rise)])
    return ThinFilm(state=state, uncorrected=found, pressure=pressure, residual=residual, steps=steps)


def mode_warnings(amplitudes: Array, modes: int) -> list[str]:
    """The warning that the polynomials do not resolve the velocity across the film; amplitudes along the last axis."""
    size = np.abs(amplitudes).reshape(-1, amplitudes.shape[-1]).max(axis=0)
    if size[-1] <= MAX_LAST_MODE * size.max():
        return []
    return [f"{modes} polynomials do not resolve the velocity across the film: load errors of some per cent"]


def _residual(film: Strip, across: Basis, linear: thin_film.Linearised) -> float:
    rise = thin_film.pressure_rise(film, across, linear.imbalance)
    missing = across.flow * abs(rise.sum() - film.pressure_difference)
    return float(max(np.abs(linear.imbalance[:, 1:]).max(), missing) / linear.force)


def _newton(
    film: Strip, across: Basis, reynolds_number: float, state: StripFlow, tolerance: float
) -> tuple[StripFlow, thin_film.Linearised | None, int]:
    """The flow at one Reynolds number, its linearisation (None without convergence), and the number of steps."""
    least = np.inf
    for steps in range(NEWTON_STEPS):
        linear = thin_film.linearise(film, across, reynolds_number, state)
        residual = _residual(film, across, linear)
        if residual <= tolerance and steps:
            return state, linear, steps
        if not residual < 100 * least:
            return state, None, steps
        least = min(least, residual)
        try:
            change, _ = thin_film.step(film, across, linear, linear.imbalance, film.pressure_difference)
        except np.linalg.LinAlgError:
            return state, None, steps
        state = StripFlow(amplitudes=state.amplitudes + change.amplitudes, flow=state.flow + change.flow)
    return state, None, NEWTON_STEPS


def _with_slope(
    film: Strip, across: Basis, reynolds_number: float, state: StripFlow, linear: thin_film.Linearised, rise: Array
) -> tuple[StripFlow, Array]:
    """The flow and its pressure rise along each cell, corrected for slope; ConvergenceError if that is not finite."""
    try:
        change, more = thin_film.step(film, across, linear, slope.imbalance(film, across, reynolds_number, state))
    except np.linalg.LinAlgError:
        more = np.full_like(rise, np.nan)
    if not np.isfinite(more).all():
        raise ConvergenceError("the slope correction of the film is not finite here; take film or navier_stokes")
    return StripFlow(amplitudes=state.amplitudes + change.amplitudes, flow=state.flow + change.flow), rise + more
