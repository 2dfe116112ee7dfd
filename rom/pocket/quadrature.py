"""Pressure, load and friction of a film by quadrature over one period of the gap."""

import time
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result
from roughfilm.rom.pocket import closed_form as film_flow
from roughfilm.rom.pocket.error_law import ErrorLaw
from roughfilm.rom.pocket.gap import Gap
from roughfilm.rom.pocket.model import MAX_NODES
from roughfilm.rom.pocket.piecewise import GaussRule, extrema, gauss_rule
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities
from roughfilm.rom.pocket.validity import cautions, ruptures


@dataclass(frozen=True, kw_only=True)
class _Film:
    """The gap h at the nodes x, shape (pieces, nodes), and half the length of each piece, in film thicknesses."""

    x: Array
    h: Array
    half: Array


def _sample(gap: Gap, nodes: Array) -> _Film:
    ends = np.array(gap.pieces)
    middle, half = ends.mean(axis=1, keepdims=True), np.diff(ends, axis=1) / 2
    x = middle + half * nodes
    return _Film(x=x / gap.film, h=gap.thickness(x) / gap.film, half=half / gap.film)


def _flow_and_residual(gap: Gap, film: _Film, rule: GaussRule) -> tuple[float, float]:
    """The flow of periodic pressure, and the relative error of the interpolated gradient between the nodes."""
    weights = film.half * rule.weights
    q = float((weights / film.h**2).sum() / (2 * (weights / film.h**3).sum()))
    between = _sample(gap, rule.check_nodes)
    exact = film_flow.pressure_gradient(between.h, q)
    interpolated = film_flow.pressure_gradient(film.h, q) @ rule.check.T
    check_weights = between.half * rule.check_weights
    mismatch = (check_weights * np.abs(interpolated - exact)).sum()
    return q, float(mismatch / (check_weights * np.abs(exact)).sum())


def solve(
    solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress, *, law: ErrorLaw | None
) -> Result:
    """Solve dp/dx = 6/h² - 12 q/h³, plus first-order inertia if the model has it, for a periodic gap.

    The flow q = ∫h⁻² dx / 2 ∫h⁻³ dx makes the pressure periodic. Without a requested resolution the number of nodes is
    doubled from 24 until the residual meets the tolerance (1e-7 by default). At a requested resolution a larger
    residual is a warning.

    Raises
    ------
    ConvergenceError
        If the residual of the finest rule exceeds the tolerance.
    """
    wall, cpu = time.perf_counter(), time.process_time()
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    tolerance, scheme = request.tolerance, request.scheme
    gap = scene.gap()
    order, tries = request.resolution, 1
    while True:
        progress(0.0, f"{order} nodes on each piece")
        rule = gauss_rule(order)
        film = _sample(gap, rule.nodes)
        q, residual = _flow_and_residual(gap, film, rule)
        if request.asked.resolution is not None or residual <= tolerance:
            break
        if order >= MAX_NODES:
            raise ConvergenceError(
                f"{model}: residual {residual:.1e} at {order} nodes on a piece misses the tolerance {tolerance:.1e}; "
                "loosen the tolerance or make the groove shallower"
            )
        order, tries = 2 * order, tries + 1

    warnings = list(cautions(scene, law))
    if residual > tolerance:
        warnings.append(f"residual {residual:.1e} at {order} nodes on a piece misses the tolerance {tolerance:.1e}")
    reynolds_number = scene.reynolds_number if Effect.INERTIA in keeps else 0.0
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
    shear = film_flow.sliding_wall_shear(film.h, q)
    length = 2 * film.half.sum()
    weights = film.half * rule.weights
    lowest, highest = extrema(film.x, pressure, gradient)
    lowest = min(lowest, float(ends.min()))
    warnings += ruptures(scene, lowest)
    quantities = pocket_quantities(
        scene,
        load=float((weights * pressure).sum() / length),
        friction=float((weights * shear).sum() / length),
        pressure_max=max(highest, float(ends.max())),
        pressure_min=lowest,
        backflow=film_flow.back_flow(film.h, q),
    )
    pascal = scene.pressure_unit
    return Result(
        model=model,
        quantities=quantities,
        fields={
            "position": Field(values=film.x.ravel() * gap.film, unit="m"),
            "film_thickness": Field(values=film.h.ravel() * gap.film, unit="m"),
            "pressure": Field(values=pressure.ravel() * pascal, unit="Pa"),
            "shear_stress": Field(values=shear.ravel() * pascal, unit="Pa"),
        },
        provenance=provenance(scene, model=model, keeps=tuple(keeps), sources=sources),
        numerics=Numerics(
            residual=residual,
            iterations=tries,
            cpu_s=time.process_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=film.x.size,
            resolution=order,
            tolerance=tolerance,
            scheme=scheme,
        ),
        warnings=tuple(warnings),
    )
