"""A film over grooves that ruptures at the cavitation pressure: its problem, its quantities and its fields."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.evaluation.filling import density_ratio
from roughfilm.rom.cavitation.evaluation.flows import flow_along
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.evaluation.peak import peak_pressure
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.result import Field
from roughfilm.rom.pocket import closed_form as film_flow
from roughfilm.rom.pocket.cavitating.cavities import cavity_quantities
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities


def groove_problem(scene: Pocket) -> Problem:
    """The film of one period between two ends that are full of liquid at ambient pressure.

    In steady flow as much liquid leaves the period as enters it, so that the film repeats itself.
    """
    gap, ambient = scene.gap(), -scene.cavitation_pressure
    shortest = min(groove.width for groove in scene.grooves)
    shape = Shape(
        thickness=lambda x, _y: gap.thickness(x), breaks=gap.breaks, wide=True, finest=(shortest, float("inf"))
    )
    ends = Ends(inlet=ambient, outlet=ambient)
    return Problem(shape=shape, ends=ends, speed=scene.speed, viscosity=scene.lubricant.viscosity)


def groove_quantities(scene: Pocket, solution: Solution) -> dict[str, Quantity]:
    """The quantities of a pocket over grooves and those of its cavities; pressures count from ambient."""
    areas, cavity = solution.grid.areas, solution.kind == CAVITY
    pressure = solution.state.pressure + scene.cavitation_pressure
    pascal, film = scene.pressure_unit, scene.geometry.film
    thickness = solution.faces.thickness[~cavity] / film
    return {
        **pocket_quantities(
            scene,
            load=float((areas * pressure).sum() / areas.sum()) / pascal,
            friction=friction(solution) / float(areas.sum()) / pascal,
            pressure_max=(peak_pressure(solution) + scene.cavitation_pressure) / pascal,
            pressure_min=float(pressure.min()) / pascal,
            backflow=film_flow.back_flow(thickness, _flow(scene, solution)),
            parts=pressure.size,
            offset=scene.cavitation_pressure / pascal,
        ),
        **cavity_quantities(solution),
    }


def groove_fields(scene: Pocket, solution: Solution) -> dict[str, Field]:
    """The fields along the sliding wall, shape (nodes,), with the density ratio θ of the film.

    In a cavity streamers from wall to wall fill the fraction θ of the gap, which carry the shear stress η u θ/h.
    """
    thickness, theta = solution.faces.thickness[:, 0], density_ratio(solution)[:, 0]
    h = thickness / scene.geometry.film
    cavity = solution.kind[:, 0] == CAVITY
    shear = np.where(cavity, theta / h, film_flow.sliding_wall_shear(h, _flow(scene, solution)))
    pressure = solution.state.pressure[:, 0] + scene.cavitation_pressure
    values: dict[str, tuple[Array, str]] = {
        "position": (solution.grid.x, "m"),
        "film_thickness": (thickness, "m"),
        "pressure": (pressure, "Pa"),
        "shear_stress": (shear * scene.pressure_unit, "Pa"),
        "density_ratio": (theta, "1"),
    }
    return {name: Field(values=np.ascontiguousarray(field), unit=unit) for name, (field, unit) in values.items()}


def _flow(scene: Pocket, solution: Solution) -> float:
    """The flow through the period over u times the film thickness outside the grooves."""
    return float(flow_along(solution)[:-1].mean()) / (scene.speed * scene.geometry.film)
