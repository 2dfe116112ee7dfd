"""A pocket scene by the thin-film equations: Newton's method, continued in the Reynolds number where it must be."""

import time
from collections.abc import Callable
from functools import partial
from typing import Unpack

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.ladder.model import About, Applicability, Effect, Model, Progress, Resolutions
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.pocket import slope, thin_film
from roughfilm.rom.pocket.basis import Basis, even_basis, gauss_basis, sliding_wall_slope
from roughfilm.rom.pocket.error_law import ErrorLaw
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities
from roughfilm.rom.pocket.thin_film import Flow, Strip
from roughfilm.rom.pocket.validity import cautions

MODES = 10
"""Polynomials across the film; 16 change load by 3e-5 and friction by 3e-4 at most, over 120 of the published cases."""

RESOLUTION = 400
RESOLUTIONS = (50, 100, 200, 400)
COARSEST, FINEST = 12, 4000
TOLERANCE = 1e-11
SCHEMES = ("linear_upwind", "upwind")
LAYERS, FINE_LAYERS = 24, 120
"""Where the velocity is given in the result, and where back-flow is looked for."""

NEWTON_STEPS = 12
MOST_STEPS = 240
SMALLEST_STEP = 1e-3
"""Of the Reynolds number, in the continuation."""

ROUGH_PROFILE = 0.1
"""A last polynomial larger than this part of the largest one says that the profile across the film is not resolved."""

RESOLUTION_MEANING = "cells along the film, each with 10 polynomials across it"
RESIDUAL_MEANING = "largest imbalance of momentum in a cell, relative to the largest force in one"


class _Count:
    """Newton steps spent, of those there are."""

    def __init__(self) -> None:
        self.spent = 0


def _residual(film: Strip, across: Basis, linear: thin_film.Linearised) -> float:
    rise = thin_film.pressure_rise(film, across, linear.imbalance)
    return float(max(np.abs(linear.imbalance[:, 1:]).max(), across.flow * abs(rise.sum())) / linear.force)


def _newton(
    film: Strip, across: Basis, reynolds_number: float, state: Flow, tolerance: float, count: _Count
) -> tuple[Flow, thin_film.Linearised] | None:
    """The flow at one Reynolds number from a guess; None where Newton's method does not find it."""
    least = np.inf
    for steps in range(NEWTON_STEPS):
        linear = thin_film.linearise(film, across, reynolds_number, state)
        residual = _residual(film, across, linear)
        if residual <= tolerance and steps:
            return state, linear
        if not residual < 100 * least:
            return None
        least = min(least, residual)
        try:
            change, _ = thin_film.step(film, across, linear, linear.imbalance)
        except np.linalg.LinAlgError:
            return None
        count.spent += 1
        state = Flow(amplitudes=state.amplitudes + change.amplitudes, flow=state.flow + change.flow)
    return None


def _continued(
    film: Strip, modes: int, reynolds_number: float, tolerance: float, progress: Progress
) -> tuple[Flow, thin_film.Linearised, int]:
    """The flow at a Reynolds number: at once, else by steps from creeping flow that grow and shrink as they succeed."""
    across, count = gauss_basis(modes), _Count()
    state, reached, stride = thin_film.creeping(film, modes), 0.0, 1.0
    while True:
        target = min(reached + stride, 1.0)
        progress(reached, f"Re = {target * reynolds_number:.4g}")
        found = _newton(film, across, target * reynolds_number, state, tolerance, count)
        if found is not None and target == 1.0:
            return *found, count.spent
        if found is not None:
            state, reached, stride = found[0], target, 2 * stride
        else:
            stride /= 4
        if stride < SMALLEST_STEP or count.spent > MOST_STEPS:
            raise ConvergenceError(
                f"the film equations have no steady flow within reach beyond Re = {reached * reynolds_number:.4g} "
                f"(asked: {reynolds_number:.4g}); take navier_stokes, a coarser resolution or a shallower groove",
                outcome=Outcome.STALLED,
            )


def _with_slope(
    film: Strip, across: Basis, reynolds_number: float, state: Flow, linear: thin_film.Linearised, rise: Array
) -> tuple[Flow, Array]:
    """The flow and its pressure rise along each cell with their answer to slope; ConvergenceError if there is none."""
    try:
        change, more = thin_film.step(film, across, linear, slope.imbalance(film, across, reynolds_number, state))
    except np.linalg.LinAlgError:
        more = np.full_like(rise, np.nan)
    if not np.isfinite(more).all():
        raise ConvergenceError("the film has no finite answer to slope here; take film or navier_stokes")
    return Flow(amplitudes=state.amplitudes + change.amplitudes, flow=state.flow + change.flow), rise + more


def solve(
    solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress, *, law: ErrorLaw
) -> Result:
    """Solve the thin-film Navier-Stokes equations (``thin_film``), with slope to second order if it is kept.

    The correction for slope (:mod:`rom.pocket.slope`) is the film's linear answer to the forces it leaves out.

    Raises
    ------
    ConvergenceError
        If no steady flow is found, or the residual does not meet the tolerance.

    Notes
    -----
    Second order in the resolution (first with the scheme ``upwind``), spectral across the film.
    """
    import scipy.linalg  # noqa: F401  # slow to import, and not the scene's cost

    wall, cpu = time.perf_counter(), time.process_time()
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    resolution, tolerance, scheme = request.resolution, request.tolerance, request.scheme
    gap, reynolds_number = scene.gap(), scene.reynolds_number
    film, across = thin_film.strip(gap, resolution, second_order=scheme == SCHEMES[0]), gauss_basis(MODES)
    with np.errstate(all="ignore"):
        state, linear, steps = _continued(film, MODES, reynolds_number, tolerance, progress)
        residual, rise = _residual(film, across, linear), thin_film.pressure_rise(film, across, linear.imbalance)
        if Effect.SLOPE in keeps:
            state, rise = _with_slope(film, across, reynolds_number, state, linear, rise)

    warnings = list(cautions(scene, law))
    size = np.abs(state.amplitudes).max(axis=0)
    if size[-1] > ROUGH_PROFILE * size.max():
        warnings.append(
            f"{MODES} polynomials do not resolve the velocity across the film; its load may be some per cent off"
        )
    pressure = np.concatenate([[0.0], np.cumsum(rise)])
    middle = (pressure[1:] + pressure[:-1]) / 2
    shear = (1 + thin_film.all_amplitudes(film, across, state) @ sliding_wall_slope(MODES)) / film.thickness
    u, v = slope.velocities(film, even_basis(MODES, LAYERS), state)
    slowest = thin_film.velocity(film, even_basis(MODES, FINE_LAYERS), state).min()
    length, pascal = film.faces[-1] - film.faces[0], scene.pressure_unit
    return Result(
        model=model,
        quantities=pocket_quantities(
            scene,
            load=float((film.lengths * middle).sum() / length),
            friction=float((film.lengths * shear).sum() / length),
            pressure_max=float(pressure.max()),
            pressure_min=float(pressure.min()),
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
            cpu_s=time.process_time() - cpu,
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


def film_model(*, applies: Callable[[Pocket], Applicability], law: ErrorLaw, **about: Unpack[About]) -> Model[Pocket]:
    """A model that solves the thin-film equations; its cost was measured from 50 to 800 cells."""
    return Model(
        **about,
        kind="pocket",
        resolutions=Resolutions(least=COARSEST, most=FINEST, default=RESOLUTION, series=RESOLUTIONS),
        resolution_meaning=RESOLUTION_MEANING,
        residual_meaning=RESIDUAL_MEANING,
        order=2,
        tolerance=TOLERANCE,
        tolerances=(1e-14, 1.0),
        schemes=SCHEMES,
        cost=lambda _scene, resolution: 3e-3 + 1e-4 * resolution,
        applies=applies,
        compute=partial(solve, law=law),
    )
