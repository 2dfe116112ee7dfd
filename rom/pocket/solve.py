"""The thin film over a pocket as a result."""

import time

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.pocket.model import SCHEMES
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities
from roughfilm.rom.pocket.validity.promise import promise_warnings
from roughfilm.rom.pocket.validity.warnings import cancellations, ruptures
from roughfilm.rom.thin_film import newton, slope, thin_film
from roughfilm.rom.thin_film.basis import even_basis, gauss_basis, sliding_wall_slope
from roughfilm.rom.thin_film.newton import MODES
from roughfilm.rom.thin_film.thin_film import Strip

LAYERS = 24
"""Number of layers across the film in the velocity of a result."""

BACKFLOW_LAYERS = 120
"""Number of layers across the film among which the back-flow is sought."""


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve the thin-film Navier-Stokes equations in a pocket (:func:`roughfilm.rom.thin_film.newton.solve`).

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge to the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    resolution, tolerance, scheme = request.resolution, request.tolerance, request.scheme
    gap, across = scene.gap(), gauss_basis(MODES)
    film = thin_film.strip(gap, resolution, second_order=scheme == SCHEMES[0])
    found = newton.solve(
        film, scene.reynolds_number, tolerance=tolerance, with_slope=Effect.SLOPE in keeps, progress=progress
    )
    state, pressure = found.state, found.pressure
    warnings = [*promise_warnings(scene, model), *newton.mode_warnings(state.amplitudes, MODES)]
    middle, lowest, highest = (pressure[1:] + pressure[:-1]) / 2, float(pressure.min()), float(pressure.max())
    shear = (1 + thin_film.all_amplitudes(film, across, state) @ sliding_wall_slope(MODES)) / film.thickness
    u, v = slope.velocities(film, even_basis(MODES, LAYERS), state)
    slowest = thin_film.velocity(film, even_basis(MODES, BACKFLOW_LAYERS), state).min()
    length, pascal = film.faces[-1] - film.faces[0], scene.pressure_unit
    load = float((film.lengths * middle).sum() / length)
    warnings += ruptures(scene, solver, lowest) + cancellations(scene, load=load, lowest=lowest, highest=highest)
    return Result(
        model=model,
        quantities=pocket_quantities(
            scene,
            load=load,
            friction=float((film.lengths * shear).sum() / length),
            pressure_max=highest,
            pressure_min=lowest,
            backflow=float(max(0.0, -slowest)),
            parts=middle.size,
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
        numerics=Numerics(
            residual=found.residual,
            iterations=found.steps,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=state.amplitudes.size + 1,
            resolution=resolution,
            tolerance=tolerance,
            scheme=scheme,
        ),
        provenance=provenance(scene, model=model, keeps=tuple(keeps), sources=sources),
        warnings=tuple(warnings),
    )


def _vertices(film: Strip) -> Array:
    y = 1 - film.face_thickness[:, None] * (1 - np.linspace(0, 1, LAYERS + 1))
    return np.stack([np.broadcast_to(film.faces[:, None], y.shape), y], axis=2)
