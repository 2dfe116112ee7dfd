"""The round-off of the quantities of a film: sums of pressures and flows that cancel are zero within it."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.rounding import round_off
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.evaluation.flows import IMBALANCE_FACTOR, flow_along
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.result import beyond_round_off

NO_LOAD = "the load is 0 within the round-off of its parts; the numbers that are ratios to it are left out"
"""The warning of a film without a load."""

PER_WIDTH = "_per_width"


def pressure_of_parts(scene: Bearing, solution: Solution) -> float:
    """The size of the pressures whose differences the quantities of a film are, Pa.

    It is the highest pressure above that of a cavity, the cavitation pressure and the pressure 6 η u L <h⁻²> by which
    an outlet that is closed would stop the flow by sliding, over the length L.
    """
    grid, problem, pressure = solution.grid, solution.problem, solution.state.pressure
    radius = float(grid.radius.mean())
    length = float(grid.volume_x.sum()) * radius
    inverse = float((grid.areas / solution.faces.thickness**2).sum() / grid.areas.sum())
    sliding = 6 * problem.viscosity * abs(problem.speed) * radius * length * inverse
    return float(np.abs(pressure).max()) + abs(scene.lubricant.cavitation_pressure) + sliding


def film_round_off(scene: Bearing, solution: Solution) -> dict[str, float]:
    """The round-off of a pressure, a force, a moment and a flow of a film, by the unit of the quantity.

    It is the size of the parts times the machine epsilon and the number of nodes, and ``IMBALANCE_FACTOR`` times the
    part of the flow along the film that the solution leaves unbalanced. The unit "friction" stands for that of a force
    along the film.
    """
    grid, pressure = solution.grid, pressure_of_parts(scene, solution)
    area, radius = float(grid.areas.sum()), float(grid.radius.mean())
    length = float(grid.volume_x.sum()) * radius
    width = area / length
    thickness = solution.faces.thickness
    conductance = float((thickness**3).mean()) / (12 * solution.problem.viscosity)
    along = pressure * conductance * float(grid.volume_y.mean()) / length
    unbalanced = solution.imbalance * min(1.0, float(np.abs(flow_along(solution)).max()) / along) if along else 0.0
    part = round_off(1.0, grid.areas.size) + IMBALANCE_FACTOR * unbalanced
    force, arm = pressure * area, length if solution.problem.shape.wide else area**0.5
    across = 0.0 if solution.problem.shape.wide else length / width
    return {
        "Pa": part * pressure,
        "N": part * force,
        "N*m": part * force * arm,
        "m^3/s": part * pressure * conductance * (width / length + across),
        "friction": part * force * float(thickness.max()) / length,
    }


def beyond_rounding(scene: Bearing, solution: Solution, quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """The quantities of a film, where those that are not larger than their round-off are 0 ± that.

    One of unknown uncertainty remains so: a grid that does not show the shape of a film shows no load.
    """
    sizes, width = film_round_off(scene, solution), 1.0 if solution.problem.shape.wide else scene.geometry.width or 1.0
    radius = float(solution.grid.radius.mean()) if solution.problem.shape.polar else 1.0
    sizes |= {"power_loss": sizes["friction"] * abs(solution.problem.speed) * radius}
    sizes |= {"torque": sizes["friction"] * (scene.turning_radius or 0.0)}
    found = {}
    for name, one in quantities.items():
        whole = name.removesuffix(PER_WIDTH)
        unit = {"m^2/s": "m^3/s", "N/m": "N"}.get(one.unit, one.unit) if name != whole else one.unit
        size = sizes.get(whole, sizes.get(unit, -1.0)) / (width if name != whole else 1.0)
        zero = beyond_round_off(one, size)
        found[name] = zero if one.uncertainty is not None else replace(zero, uncertainty=None)
    return found
