"""Newton's method for the thin-film equations of a pocket, with continuation in the Reynolds number if needed."""

import time

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.pocket.model import SCHEMES
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities
from roughfilm.rom.pocket.validity.promise import promise_warnings
from roughfilm.rom.pocket.validity.warnings import cancellations, cautions, ruptures
from roughfilm.rom.thin_film import slope, thin_film
from roughfilm.rom.thin_film.basis import Basis, even_basis, gauss_basis, sliding_wall_slope
from roughfilm.rom.thin_film.thin_film import Strip, StripFlow

MODES = 10
"""Polynomials across the film; with 16 load changes by at most 3e-5 and friction by 3e-4 in 120 published cases."""

LAYERS = 24
"""Number of layers across the film in the velocity of a result."""

BACKFLOW_LAYERS = 120
"""Number of layers across the film among which the back-flow is sought."""

NEWTON_STEPS = 12
"""Largest number of Newton steps at one Reynolds number."""

MAX_TOTAL_STEPS = 240
"""Number of Newton steps in all after which the continuation stops."""

MIN_CONTINUATION_STEP = 1e-3
"""Smallest continuation step over the Reynolds number of the scene."""

MAX_LAST_MODE = 0.1
"""Largest last amplitude over the largest one at which the velocity across the film is resolved."""


def _residual(film: Strip, across: Basis, linear: thin_film.Linearised) -> float:
    rise = thin_film.pressure_rise(film, across, linear.imbalance)
    return float(max(np.abs(linear.imbalance[:, 1:]).max(), across.flow * abs(rise.sum())) / linear.force)


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
            change, _ = thin_film.step(film, across, linear, linear.imbalance)
        except np.linalg.LinAlgError:
            return state, None, steps
        state = StripFlow(amplitudes=state.amplitudes + change.amplitudes, flow=state.flow + change.flow)
    return state, None, NEWTON_STEPS


def _continued(
    film: Strip, modes: int, reynolds_number: float, tolerance: float, progress: Progress
) -> tuple[StripFlow, thin_film.Linearised, int]:
    """The flow at a Reynolds number, if necessary by continuation from creeping flow in steps of adapted size."""
    across, total = gauss_basis(modes), 0
    state, reached, stride = thin_film.creeping(film, modes), 0.0, 1.0
    while True:
        target = min(reached + stride, 1.0)
        progress(reached, f"Re = {target * reynolds_number:.4g}")
        solution, linear, steps = _newton(film, across, target * reynolds_number, state, tolerance)
        total += steps
        if linear is not None and target == 1.0:
            return solution, linear, total
        if linear is not None:
            state, reached, stride = solution, target, 2 * stride
        else:
            stride /= 4
        if stride < MIN_CONTINUATION_STEP or total > MAX_TOTAL_STEPS:
            raise ConvergenceError(
                f"the film equations did not converge to a steady flow above Re = {reached * reynolds_number:.4g} "
                f"(requested: {reynolds_number:.4g}); take navier_stokes, a coarser resolution or a shallower groove",
                outcome=Outcome.STALLED,
            )


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


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve the thin-film Navier-Stokes equations (``thin_film``), with slope to second order if the model has it.

    The correction for slope (:mod:`roughfilm.rom.thin_film.slope`) is the linear response of the film to the neglected
    forces. The error is of second order in the cell size (of first order with the scheme ``upwind``), and spectral
    across the film.

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge to the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    resolution, tolerance, scheme = request.resolution, request.tolerance, request.scheme
    gap, reynolds_number = scene.gap(), scene.reynolds_number
    film, across = thin_film.strip(gap, resolution, second_order=scheme == SCHEMES[0]), gauss_basis(MODES)
    with np.errstate(all="ignore"):
        state, linear, steps = _continued(film, MODES, reynolds_number, tolerance, progress)
        residual, rise = _residual(film, across, linear), thin_film.pressure_rise(film, across, linear.imbalance)
        if Effect.SLOPE in keeps:
            state, rise = _with_slope(film, across, reynolds_number, state, linear, rise)

    warnings = [*cautions(scene), *promise_warnings(scene, model)]
    size = np.abs(state.amplitudes).max(axis=0)
    if size[-1] > MAX_LAST_MODE * size.max():
        warnings.append(
            f"{MODES} polynomials do not resolve the velocity across the film: load errors of some per cent"
        )
    pressure = np.concatenate([[0.0], np.cumsum(rise)])
    middle, lowest, highest = (pressure[1:] + pressure[:-1]) / 2, float(pressure.min()), float(pressure.max())
    shear = (1 + thin_film.all_amplitudes(film, across, state) @ sliding_wall_slope(MODES)) / film.thickness
    u, v = slope.velocities(film, even_basis(MODES, LAYERS), state)
    slowest = thin_film.velocity(film, even_basis(MODES, BACKFLOW_LAYERS), state).min()
    length, pascal = film.faces[-1] - film.faces[0], scene.pressure_unit
    load = float((film.lengths * middle).sum() / length)
    warnings += ruptures(scene, lowest) + cancellations(scene, load=load, lowest=lowest, highest=highest)
    return Result(
        model=model,
        quantities=pocket_quantities(
            scene,
            load=load,
            friction=float((film.lengths * shear).sum() / length),
            pressure_max=highest,
            pressure_min=lowest,
            backflow=float(max(0.0, -slowest)),
        ),
        fields={
            "position": Field(values=film.centres * gap.film, unit="m"),
            "film_thickness": Field(values=film.thickness * gap.film, unit="m"),
            "pressure": Field(values=middle * pascal, unit="Pa"),
            "shear_stress": Field(values=shear * pascal, unit="Pa"),
            "vertices": Field(values=_vertices(film) * gap.film, unit="m"),
            "cell_velocity": Field(values=np.stack([u, v], axis=2) * scene.speed, unit="m/s"),
            "cell_pressure": Field(values=np.repeat(middle[:, None], LAYERS, axis=1) * pascal, unit="Pa"),
        },
        provenance=provenance(scene, model=model, keeps=tuple(keeps), sources=sources),
        numerics=Numerics(
            residual=residual,
            iterations=steps,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=state.amplitudes.size + 1,
            resolution=resolution,
            tolerance=tolerance,
            scheme=scheme,
        ),
        warnings=tuple(warnings),
    )


def _vertices(film: Strip) -> Array:
    h = np.append(film.face_thickness, film.face_thickness[0])
    y = 1 - h[:, None] * (1 - np.linspace(0, 1, LAYERS + 1))
    return np.stack([np.broadcast_to(film.faces[:, None], y.shape), y], axis=2)
