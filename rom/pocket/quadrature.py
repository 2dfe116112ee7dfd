"""Pressure, load and friction of a film by quadrature over one period of the gap."""

import time

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.pocket import closed_form as film_flow
from roughfilm.rom.pocket.model import MAX_NODES
from roughfilm.rom.pocket.piecewise import gauss_rule
from roughfilm.rom.pocket.pressure import film_pressure, flow_and_residual, mean, sample
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities
from roughfilm.rom.pocket.validity.promise import promise_warnings
from roughfilm.rom.pocket.validity.warnings import ruptures


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve dp/dx = 6/h² - 12 q/h³, plus first-order inertia if the model has it, for a periodic gap.

    The flow q = ∫h⁻² dx / 2 ∫h⁻³ dx makes the pressure periodic. Without a requested resolution the number of nodes is
    doubled from 24 until the residual meets the tolerance (1e-7 by default). At a requested resolution a larger
    residual is a warning.

    Raises
    ------
    ConvergenceError
        If the residual of the finest rule exceeds the tolerance.
    """
    wall, cpu = time.perf_counter(), working_time()
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    tolerance, scheme = request.tolerance, request.scheme
    gap = scene.gap()
    order, tries = request.resolution, 1
    while True:
        progress(0.0, f"{order} nodes on each piece")
        rule = gauss_rule(order)
        film = sample(gap, rule.nodes)
        q, residual = flow_and_residual(gap, film, rule)
        if request.asked.resolution is not None or residual <= tolerance:
            break
        if order >= MAX_NODES:
            raise ConvergenceError(
                f"{model}: residual {residual:.1e} at {order} nodes on a piece misses the tolerance {tolerance:.1e}; "
                "loosen the tolerance or make the groove shallower"
            )
        order, tries = 2 * order, tries + 1

    warnings = [*promise_warnings(scene, model)]
    if residual > tolerance:
        warnings.append(f"residual {residual:.1e} at {order} nodes on a piece misses the tolerance {tolerance:.1e}")
    flow = film_pressure(gap, film, rule, q, scene.reynolds_number if Effect.INERTIA in keeps else 0.0)
    shear = film_flow.sliding_wall_shear(film.h, q)
    warnings += ruptures(scene, solver, flow.lowest)
    quantities = pocket_quantities(
        scene,
        load=flow.load,
        friction=mean(film, rule, shear),
        pressure_max=flow.highest,
        pressure_min=flow.lowest,
        backflow=film_flow.back_flow(film.h, q),
        parts=film.h.size,
    )
    pascal = scene.pressure_unit
    return Result(
        model=model,
        quantities=quantities,
        fields={
            "position": Field(values=film.x.ravel() * gap.film, unit="m"),
            "film_thickness": Field(values=film.h.ravel() * gap.film, unit="m"),
            "pressure": Field(values=flow.pressure.ravel() * pascal, unit="Pa"),
            "shear_stress": Field(values=shear.ravel() * pascal, unit="Pa"),
        },
        provenance=provenance(scene, model=model, keeps=tuple(keeps), sources=sources),
        numerics=Numerics(
            residual=residual,
            iterations=tries,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=film.x.size,
            resolution=order,
            tolerance=tolerance,
            scheme=scheme,
        ),
        warnings=tuple(warnings),
    )
