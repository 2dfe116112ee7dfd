"""What a mixed film at a given separation carries, rubs and leaks, and how far off that may be."""

from collections.abc import Mapping

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.film import averages
from roughfilm.rom.bearing.mixed.film import mixed_problem
from roughfilm.rom.bearing.mixed.touching import Touching, touching
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.quantities import bearing_quantities, carried
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.model import Applicability


def mixed_quantities(scene: Bearing, found: Solution) -> dict[str, Quantity]:
    """As :func:`roughfilm.rom.bearing.quantities.bearing_quantities`, with what the asperities carry beside the film.

    ``load`` and ``friction`` (and those per width) are of both together, of a journal added up as vectors;
    ``contact_load`` is that of the asperities alone and ``film_load`` the rest, ``contact_share`` the former over the
    load; ``contact_pressure_max`` is averaged over the roughness, ``contact_area`` a part of the nominal area, and
    ``least_gap`` the mean gap at the narrowest place.
    """
    assert scene.asperities is not None
    contact = _contact(scene, found)
    told = bearing_quantities(scene, found, contact.force)
    width = 1.0 if found.problem.shape.wide else scene.geometry.width or 1.0
    pressed = carried(scene, -found.grid.x if found.turned else found.grid.x, contact.force)
    load = told["load_per_width"].value * width
    narrowest = float(asperities_of(scene).mean_gap(np.array([_narrowest(found)]))[0])
    values = {
        "contact_load_per_width": (pressed / width, "N/m"),
        "film_load_per_width": ((load - pressed) / width, "N/m"),
        "contact_pressure_max": (contact.pressure_max, "Pa"),
        "contact_area": (contact.area_fraction, "1"),
        "least_gap": (narrowest, "m"),
    }
    if not found.problem.shape.wide:
        values |= {"contact_load": (pressed, "N"), "film_load": (load - pressed, "N")}
    if "friction_coefficient" in told:
        values["contact_share"] = (pressed / load, "1")
    return told | {name: Quantity(value=value, unit=unit) for name, (value, unit) in values.items()}


def mixed_doubt(scene: Bearing, found: Solution, quantities: Mapping[str, Quantity]) -> dict[str, float]:
    """By how much each quantity may be off as flow factors and contact pressures are, in its unit."""
    assert scene.asperities is not None
    asperities, narrowest = asperities_of(scene), _narrowest(found)
    of_film = asperities.doubt_above(narrowest)
    of_contact = float(asperities.pressure_doubt(np.array([narrowest]))[0])
    contact_load = quantities["contact_load_per_width"].value
    film_load = abs(quantities["film_load_per_width"].value)
    load = film_load + contact_load or 1.0
    pressed = min(of_contact * contact_load, load) / load
    of_both = of_film * film_load / load + pressed
    boundary = scene.asperities.friction * contact_load
    rubbed = quantities["friction_per_width"].value
    of_rub = of_film + asperities.friction_doubt(narrowest)
    of_friction = (of_rub * abs(rubbed - boundary) + of_contact * boundary) / (abs(rubbed) or 1.0)
    parts = {
        **dict.fromkeys(("load", "load_per_width", "contact_share", "attitude_angle", "sommerfeld_number"), of_both),
        **dict.fromkeys(("friction", "friction_per_width"), of_friction),
        "friction_coefficient": of_friction + of_both,
        **dict.fromkeys(("contact_load", "contact_load_per_width", "contact_pressure_max", "contact_area"), of_contact),
        "least_gap": 0.0,
    }
    return {name: abs(quantity.value) * parts.get(name, of_film) for name, quantity in quantities.items()}


def mixed_fields(scene: Bearing, found: Solution) -> dict[str, tuple[Array, str]]:
    """The mean pressure of the asperities over each node's control volume, and the mean gap."""
    asperities = asperities_of(scene)
    return {
        "contact_pressure": (_contact(scene, found).force / found.grid.areas, "Pa"),
        "mean_gap": (asperities.mean_gap(found.faces.thickness), "m"),
    }


def touching_film(scene: Bearing) -> Problem:
    """The film of a scene, averaged over its asperities."""
    return mixed_problem(scene, asperities_of(scene))


def touches(scene: Bearing) -> Applicability:
    """Whether it is told what happens where walls touch."""
    if scene.asperities is None:
        return Applicability(applies=False, reason="the scene does not say of what the walls are that may touch")
    return averages(scene)


def _contact(scene: Bearing, found: Solution) -> Touching:
    return touching(found.problem.shape, found.grid, asperities_of(scene))


def _narrowest(found: Solution) -> float:
    return float(found.faces.thickness.min())
