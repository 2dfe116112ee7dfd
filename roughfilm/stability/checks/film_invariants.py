"""Laws of films, over grooves and in bearings: energy, means between extremes, mass, and what adds up to a load."""

from collections.abc import Iterator

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shapes import Journal
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.scene import Pocket

ROUNDING = 1e-9

COARSE = 0.05
"""Friction may be below its bound by this part of it, which coarse meshes miss."""

SAMPLES = 20_000
"""Of the film along a period, midpoints between its breaks."""


def pocket(scene: Pocket, result: Result) -> Iterator[str]:
    """A load lies between the extremes of pressure; friction dissipates at least as much as shear across the film.

    The wall's work is what the liquid dissipates, ∫∫(∂u/∂y)² and more, which is at least ∫ η u²/h dx; models that warn
    of themselves may lose some of it.
    """
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    low, high = value["pressure_min_plus"], value["pressure_max_plus"]
    slack = ROUNDING * max(abs(low), abs(high)) + 1e-12
    if not low - slack <= value["load_plus"] <= high + slack:
        yield f"load+ {value['load_plus']:.6g} outside of the pressures, {low:.6g} to {high:.6g}"
    least = scene.plus_factor * _mean_inverse(scene) * scene.geometry.film
    if not result.warnings and value["friction_plus"] < (1 - COARSE) * least:
        yield f"friction+ {value['friction_plus']:.6g} is less than shear alone takes, {least:.6g}"
    if value["backflow"] < 0:
        yield f"backflow {value['backflow']:.3g} is below 0"
    if (result.fields["film_thickness"].values < scene.geometry.film * (1 - 1e-6)).any():
        yield "the film is thinner than outside of the grooves"
    for name in ("load", "friction"):
        per_area = value[f"{name}_per_area"] / scene.pressure_unit * scene.plus_factor
        if abs(per_area - value[f"{name}_plus"]) > ROUNDING * abs(per_area) + 1e-12:
            yield f"{name}+ and {name} per area do not agree"


def _mean_inverse(scene: Pocket) -> float:
    """<1/h>, 1/m."""
    gap = scene.gap()
    places, weights = [], []
    for begin, end in zip(gap.breaks, gap.breaks[1:], strict=False):
        points = max(50, round(SAMPLES * (end - begin) / scene.geometry.length))
        places.append(begin + (np.arange(points) + 0.5) / points * (end - begin))
        weights.append(np.full(points, (end - begin) / points))
    inverse = 1 / gap.thickness(np.concatenate(places))
    return float((np.concatenate(weights) * inverse).sum()) / scene.geometry.length


def bearing(scene: Bearing, result: Result) -> Iterator[str]:
    """Pressure above that of cavitation, what fills a gap at most the gap, and loads that add up from pressures.

    Where all around is ambient, the wall's work is dissipated or pumps against cavities: it is not below 0.
    """
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    field = {name: found.values for name, found in result.fields.items()}
    lowest, pressure = scene.lubricant.cavitation_pressure, field["pressure"]
    slack = ROUNDING * max(float(np.abs(pressure).max()), abs(lowest))
    ruptures = "cavitation" in result.provenance["keeps"]
    if ruptures and pressure.min() < lowest - slack:
        yield f"pressure {pressure.min():.6g} Pa is below that of cavitation, {lowest:.6g} Pa"
    theta = field["density_ratio"]
    if theta.min() < 0 or abs(value["theta_min"] - theta.min()) > ROUNDING:
        yield f"the gap is filled to {theta.min():.6g}, told {value['theta_min']:.6g}"
    if abs(value["pressure_max"] - pressure.max()) > slack:
        yield f"the greatest pressure is {pressure.max():.6g} Pa, told {value['pressure_max']:.6g}"
    if field["film_thickness"].min() <= 0 and result.model != "mixed":
        yield "the film has no thickness"
    for name in ("film_start", "rupture", "cavitated_fraction"):
        if not -ROUNDING <= value[name] <= 1 + ROUNDING:
            yield f"{name} is {value[name]:.6g}, not a part"
    yield from _loads(scene, value, field)
    own = scene.boundary == type(scene.boundary)()
    if own and scene.motion.speed and result.model != "mixed" and value["friction_per_width"] < 0:
        yield f"the film drives the wall, friction {value['friction_per_width']:.6g} N/m"
    if result.model == "mixed":
        yield from _touching(scene, value, field)


def _loads(scene: Bearing, value: dict[str, float], field: dict[str, Array]) -> Iterator[str]:
    """The load is that of the pressures on the control volumes of the nodes, of a journal as a vector."""
    x, y = field["x"][:, 0], field["y"][0]
    across = (np.ones(1) if y.size == 1 else _lengths(y, None)) * (y if isinstance(scene.geometry, Ring) else 1)
    turn = scene.geometry.turn if isinstance(scene.geometry, Ring) and scene.geometry.endless else None
    areas = _lengths(x, turn)[:, None] * across
    pressed = areas * field["contact_pressure"] if "contact_pressure" in field else np.zeros(areas.shape)
    forces = {"load_per_width": areas * field["pressure"] + pressed}
    if "contact_pressure" in field:
        forces["contact_load_per_width"] = pressed
    width = 1.0 if y.size == 1 else scene.geometry.width or 1.0
    for name, force in forces.items():
        found = float(force.sum())
        if isinstance(scene.geometry, Journal):
            angle = (x / scene.geometry.radius)[:, None]
            found = float(np.hypot((force * np.cos(angle)).sum(), (force * np.sin(angle)).sum()))
        if abs(found / width - value[name]) > 1e-6 * float(np.abs(force).sum()) / width:
            yield f"{name} is {value[name]:.9g} N/m, but pressures add up to {found / width:.9g}"


def _lengths(places: Array, turn: float | None) -> Array:
    """Of the control volumes; round a ``turn`` the last node is followed by the first."""
    before = np.diff(places, prepend=places[0] if turn is None else places[-1] - turn)
    after = np.diff(places, append=places[-1] if turn is None else places[0] + turn)
    return np.asarray((before + after) / 2)


def _touching(scene: Bearing, value: dict[str, float], field: dict[str, Array]) -> Iterator[str]:
    """Film and asperities together carry the load and rub; what touches is a part of the walls."""
    assert scene.asperities is not None
    load, film, contact = (value[f"{part}load_per_width"] for part in ("", "film_", "contact_"))
    if abs(film + contact - load) > ROUNDING * (abs(film) + contact):
        yield f"film {film:.6g} and contact {contact:.6g} N/m do not add up to the load, {load:.6g}"
    if contact < 0 or field["contact_pressure"].min() < 0 or field["mean_gap"].min() < 0:
        yield "asperities pull, or the mean gap is below 0"
    if not 0 <= value["contact_area"] <= 1:
        yield f"the contact area is {value['contact_area']:.6g}, not a part"
    if (contact > 0) != (value["contact_area"] > 0):
        yield f"a contact load of {contact:.6g} N/m on an area of {value['contact_area']:.6g}"
    plain = scene.boundary == type(scene.boundary)() and not isinstance(scene.geometry, Journal)
    if plain and scene.motion.speed > 0 and value["friction_per_width"] < scene.asperities.friction * contact:
        yield f"friction {value['friction_per_width']:.6g} N/m is less than that of the asperities alone"
