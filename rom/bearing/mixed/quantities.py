"""The quantities, uncertainties and fields of a mixed film."""

from collections.abc import Mapping
from functools import partial

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.equilibrium.expected import expected_film
from roughfilm.rom.bearing.equilibrium.grids import LOAD_TOLERANCE
from roughfilm.rom.bearing.film import Searched
from roughfilm.rom.bearing.flash import flash_temperature, flash_warnings
from roughfilm.rom.bearing.mixed.contact_load import AsperityLoad, asperity_load
from roughfilm.rom.bearing.mixed.film import MixedFilm, mixed_problem
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.quantities import Fields, Outputs, bearing_quantities, load_of, scene_positions
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import solve
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution

_OF_LOAD = (
    "load",
    "load_per_width",
    "specific_load",
    "contact_share",
    "attitude_angle",
    "sommerfeld_number",
    "hersey_number",
)
"""Quantities whose uncertainty is that of film and contact load."""

_OF_FRICTION = tuple(f"{name}{per}" for name in ("friction", "power_loss", "torque") for per in ("", "_per_width"))
"""Quantities whose uncertainty is that of viscous and boundary friction."""


def contact_quantities(scene: Bearing, solution: Solution) -> dict[str, Quantity]:
    """The quantities of :func:`roughfilm.rom.bearing.quantities.bearing_quantities` and those of the asperities.

    ``load`` and ``friction`` are those of film and asperities together; in a journal bearing loads add up as vectors.
    ``contact_load`` is the load of the asperities, ``film_load`` the rest, ``contact_share`` the contact load over the
    load, ``contact_pressure_max`` an average over the roughness, ``contact_area`` a fraction of the nominal area, and
    ``least_gap`` the mean gap at the narrowest place.
    """
    assert scene.asperities is not None
    contact = _contact(scene, solution)
    quantities = bearing_quantities(scene, solution, contact.force)
    width = 1.0 if solution.problem.shape.wide else scene.geometry.width or 1.0
    pressed = load_of(scene, scene_positions(solution), contact.force)
    load = quantities["load_per_width"].value * width
    narrowest = float(asperities_of(scene).mean_gap(np.array([_narrowest(solution)]))[0])
    values = {
        "contact_load_per_width": (pressed / width, "N/m"),
        "film_load_per_width": ((load - pressed) / width, "N/m"),
        "contact_pressure_max": (contact.pressure_max, "Pa"),
        "contact_area": (contact.area_fraction, "1"),
        "least_gap": (narrowest, "m"),
    }
    if not solution.problem.shape.wide:
        values |= {"contact_load": (pressed, "N"), "film_load": (load - pressed, "N")}
    if "friction_coefficient" in quantities:
        values["contact_share"] = (pressed / load, "1")
    return quantities | {name: Quantity(value=value, unit=unit) for name, (value, unit) in values.items()}


def mixed_uncertainties(scene: Bearing, solution: Solution, quantities: Mapping[str, Quantity]) -> dict[str, float]:
    """The uncertainty of each quantity, in its unit, that comes from flow factors and contact pressures."""
    assert scene.asperities is not None
    asperities, narrowest = asperities_of(scene), _narrowest(solution)
    of_film = asperities.factor_uncertainty(narrowest)
    of_contact = float(asperities.pressure_uncertainty(np.array([narrowest]))[0])
    contact_load = quantities["contact_load_per_width"].value
    film_load = abs(quantities["film_load_per_width"].value)
    load = film_load + contact_load or 1.0
    pressed = min(of_contact * contact_load, load) / load
    of_both = of_film * film_load / load + pressed
    boundary = scene.boundary_friction * contact_load
    friction = quantities["friction_per_width"].value
    of_shear = of_film + asperities.friction_uncertainty(narrowest)
    of_friction = (of_shear * abs(friction - boundary) + of_contact * boundary) / (abs(friction) or 1.0)
    relative = {
        **dict.fromkeys(_OF_LOAD, of_both),
        **dict.fromkeys(_OF_FRICTION, of_friction),
        "friction_coefficient": of_friction + of_both,
        **dict.fromkeys(("contact_load", "contact_load_per_width", "contact_pressure_max", "contact_area"), of_contact),
        "least_gap": 0.0,
    }
    return {name: abs(quantity.value) * relative.get(name, of_film) for name, quantity in quantities.items()}


def mixed_fields(scene: Bearing, solution: Solution) -> Fields:
    """The contact pressure averaged over the control volume of each node, and the mean gap."""
    asperities = asperities_of(scene)
    return {
        "contact_pressure": (_contact(scene, solution).force / solution.grid.areas, "Pa"),
        "mean_gap": (asperities.mean_gap(solution.faces.thickness), "m"),
    }


def flash_quantities(scene: Bearing, solution: Solution) -> dict[str, Quantity]:
    """The flash temperature of the asperities of scenes with ``asperities.solid_heat``, where asperities touch.

    ``flash_temperature`` estimates how much hotter the spots in contact are than the walls at the largest contact
    pressure, between ``flash_temperature_low`` and ``flash_temperature_high``
    (:func:`roughfilm.rom.bearing.flash.rise_of_spots`).

    Raises
    ------
    ConvergenceError
        If the contact does not converge.
    """
    flash = flash_temperature(scene, _contact(scene, solution).pressure_max, scene.boundary_friction)
    return {} if flash is None else {name: Quantity(value=value, unit="K") for name, value in flash.named.items()}


def mixed_warnings(scene: Bearing, solution: Solution) -> list[str]:
    """Warnings about a peak pressure beyond linear elasticity, and a flash temperature outside of its range."""
    spots = asperities_of(scene).spot_pressures(_narrowest(solution))
    pressure = _contact(scene, solution).pressure_max
    flash = flash_temperature(scene, pressure, scene.boundary_friction)
    return [*spots.warnings, *([] if flash is None else flash_warnings(scene, pressure, flash))]


def mixed_outside(scene: Bearing, solution: Solution) -> tuple[str, ...]:
    """The sentence on contacts whose mean pressure is beyond linear elasticity, at the narrowest place."""
    return asperities_of(scene).spot_pressures(_narrowest(solution)).outside


MIXED_OUTPUTS = Outputs(
    quantities=contact_quantities,
    factor_uncertainties=mixed_uncertainties,
    fields=mixed_fields,
    warnings=mixed_warnings,
    outside=mixed_outside,
    of_finest=flash_quantities,
)


def _contact(scene: Bearing, solution: Solution) -> AsperityLoad:
    return asperity_load(solution.problem.shape, solution.grid, asperities_of(scene))


def _narrowest(solution: Solution) -> float:
    return float(solution.faces.thickness.min())


def film_of_scene(scene: Bearing) -> Problem:
    """The problem of the film of a scene, averaged over its asperities."""
    return mixed_problem(scene, asperities_of(scene))


def mixed_films(scene: Bearing, cells: int) -> MixedFilm:
    """The mixed films of a scene on a grid, among which that under a load is sought."""
    return MixedFilm(scene=scene, asperities=asperities_of(scene), cells=cells, accuracy=LOAD_TOLERANCE)


def searched_films(scene: Bearing) -> Searched:
    """The films averaged over the asperities; they begin where the asperities touch, or above it as expected."""
    asperities = asperities_of(scene)
    first = max(expected_film(scene).thickness, asperities.closest + scene.geometry.dip)
    return Searched(film=film_of_scene, closest=asperities.closest, first=first, averaged=True)


solve_mixed = partial(solve, outputs=MIXED_OUTPUTS, films=mixed_films, contact=asperities_of)
"""The solver of the model ``mixed``."""
