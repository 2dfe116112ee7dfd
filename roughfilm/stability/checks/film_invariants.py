"""Physical laws of films over grooves and in bearings: energy, mean values, mass, and loads as sums of pressures."""

from collections.abc import Iterator

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.journal import Journal, Shaft
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.stability.checks.cavitation import control_lengths

ROUND_OFF = 1e-9
"""Allowed relative difference of values that are equal but for round-off."""

REPORTED = 1e-6
"""The same of a value that is reported and that of the fields: ``heat_balance`` moves the former to its temperature."""

COARSE_MESH_TOLERANCE = 0.05
"""Allowed relative deficit of friction below its bound on a coarse mesh."""

SAMPLES = 20_000
"""Approximate number of midpoints along a period in the mean of 1/h."""


def pocket(scene: Pocket, result: Result) -> Iterator[str]:
    """The laws that a pocket's result violates, in words.

    The load is within the range of the pressure. The wall's work equals the dissipation, which is at least
    ∫ η u²/h dx; this bound is not checked for a result with warnings or cavities. The backflow is not negative, and the
    film is not thinner than outside of the grooves.
    """
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    low, high = value["pressure_min_plus"], value["pressure_max_plus"]
    slack = ROUND_OFF * max(abs(low), abs(high)) + 1e-12
    if not low - slack <= value["load_plus"] <= high + slack:
        yield f"load+ {value['load_plus']:.6g} is outside of the pressures, {low:.6g} to {high:.6g}"
    least = scene.plus_factor * _mean_inverse(scene) * scene.geometry.film
    whole = not result.warnings and value.get("cavitated_fraction", 0.0) == 0
    if whole and value["friction_plus"] < (1 - COARSE_MESH_TOLERANCE) * least:
        yield f"friction+ {value['friction_plus']:.6g} is below that of plain shear, {least:.6g}"
    if value["backflow"] < 0:
        yield f"backflow {value['backflow']:.3g} is below 0"
    if (result.fields["film_thickness"].values < scene.geometry.film * (1 - 1e-6)).any():
        yield "the film is thinner than outside of the grooves"
    for name in ("load", "friction"):
        per_area = value[f"{name}_per_area"] / scene.pressure_unit * scene.plus_factor
        if abs(per_area - value[f"{name}_plus"]) > ROUND_OFF * abs(per_area) + 1e-12:
            yield f"{name}+ and {name} per area do not agree"


def _mean_inverse(scene: Pocket) -> float:
    """The mean of 1/h over a period, 1/m."""
    gap = scene.gap()
    places, weights = [], []
    for begin, end in zip(gap.breaks, gap.breaks[1:], strict=False):
        points = max(50, round(SAMPLES * (end - begin) / scene.geometry.length))
        places.append(begin + (np.arange(points) + 0.5) / points * (end - begin))
        weights.append(np.full(points, (end - begin) / points))
    inverse = 1 / gap.thickness(np.concatenate(places))
    return float((np.concatenate(weights) * inverse).sum()) / scene.geometry.length


def bearing(scene: Bearing, result: Result) -> Iterator[str]:
    """The laws that a bearing's result violates, in words.

    The pressure is not below the cavitation pressure, the filling fraction is not negative, and the load is the sum of
    the pressures. If the pressure is ambient on all sides, the wall's work is dissipated or pumps liquid against
    cavities, and is not negative.
    """
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    field = {name: one.values for name, one in result.fields.items()}
    lowest, pressure = scene.lubricant.cavitation_pressure, field["pressure"]
    slack = ROUND_OFF * max(float(np.abs(pressure).max()), abs(lowest))
    if "cavitation" in result.provenance["keeps"] and pressure.min() < lowest - slack:
        yield f"pressure {pressure.min():.6g} Pa is below that of cavitation, {lowest:.6g} Pa"
    touching = "contact_pressure" in field
    theta = field["density_ratio"]
    reported = value.get("theta_min", theta.min())  # films that stay whole have none
    if theta.min() < 0 or abs(reported - theta.min()) > REPORTED:
        yield f"the smallest density ratio is {theta.min():.6g}, reported {reported:.6g}"
    rounding = REPORTED * max(float(np.abs(pressure).max()), abs(lowest))
    if value["pressure_max"] == 0:
        rounding += result.quantities["pressure_max"].uncertainty or 0.0
    if not -rounding <= value["pressure_max"] - pressure.max() <= _most_above(pressure) + rounding:
        yield f"the greatest pressure at a node is {pressure.max():.6g} Pa, reported {value['pressure_max']:.6g}"
    if field["film_thickness"].min() <= 0 and not touching:
        yield "the film has no thickness"
    for name in value.keys() & {"film_start", "rupture", "cavitated_fraction"}:
        if not -ROUND_OFF <= value[name] <= 1 + ROUND_OFF:
            yield f"{name} is {value[name]:.6g}, not a fraction"
    yield from _loads(scene, result, field)
    ambient = scene.boundary == type(scene.boundary)()
    if ambient and scene.motion.speed and not touching and value["friction_per_width"] < 0:
        yield f"the film drives the wall, friction {value['friction_per_width']:.6g} N/m"
    if touching:
        yield from _touching(scene, value, field)


def _most_above(pressure: Array) -> float:
    """The most by which a peak between nodes exceeds the highest node: a quarter of the drop to its lowest neighbour.

    A parabola through three points whose middle one is the highest exceeds it by at most an eighth of that drop.
    """
    peak = np.unravel_index(np.argmax(pressure), pressure.shape)
    nearest = pressure
    for axis, at in enumerate(peak):
        nearest = nearest.take(range(int(at) - 1, int(at) + 2), axis=axis, mode="wrap")
    return float(pressure.max() - nearest.min()) / 4


def _loads(scene: Bearing, result: Result, field: dict[str, Array]) -> Iterator[str]:
    """The loads that are not the sum of the pressures on the control volumes, in words; on a shaft vectors add up."""
    x, y = field["x"][:, 0], field["y"][0]
    across = (np.ones(1) if y.size == 1 else control_lengths(y, None)) * (y if isinstance(scene.geometry, Ring) else 1)
    turn = scene.geometry.turn if isinstance(scene.geometry, Ring) and scene.geometry.endless else None
    if isinstance(scene.geometry, Lobes) and not scene.geometry.single:
        turn = scene.geometry.length
    areas = control_lengths(x, turn)[:, None] * across
    pressed = areas * field["contact_pressure"] if "contact_pressure" in field else np.zeros(areas.shape)
    forces = {"load_per_width": areas * field["pressure"] + pressed}
    if "contact_pressure" in field:
        forces["contact_load_per_width"] = pressed
    width = 1.0 if y.size == 1 else scene.geometry.width or 1.0
    for name, force in forces.items():
        stated = result.quantities[name]
        rounding = stated.uncertainty or 0.0 if stated.value == 0 else 0.0
        total = float(force.sum())
        if isinstance(scene.geometry, Shaft):
            angle = (x / scene.geometry.radius)[:, None]
            total = float(np.hypot((force * np.cos(angle)).sum(), (force * np.sin(angle)).sum()))
        if abs(total / width - stated.value) > rounding + REPORTED * float(np.abs(force).sum()) / width:
            yield f"{name} is {stated.value:.9g} N/m, but pressures add up to {total / width:.9g}"


def _touching(scene: Bearing, value: dict[str, float], field: dict[str, Array]) -> Iterator[str]:
    """The laws of contact that a mixed film violates, in words: film and asperities share the load and the friction."""
    assert scene.asperities is not None
    load, film, contact = (value[f"{part}load_per_width"] for part in ("", "film_", "contact_"))
    if abs(film + contact - load) > ROUND_OFF * (abs(film) + contact):
        yield f"film {film:.6g} and contact {contact:.6g} N/m do not add up to the load, {load:.6g}"
    if contact < 0 or field["contact_pressure"].min() < 0 or field["mean_gap"].min() < 0:
        yield "asperities pull, or the mean gap is below 0"
    if not 0 <= value["contact_area"] <= 1:
        yield f"the contact area is {value['contact_area']:.6g}, not a fraction"
    if (contact > 0) != (value["contact_area"] > 0):
        yield f"a contact load of {contact:.6g} N/m on an area of {value['contact_area']:.6g}"
    ambient = scene.boundary == type(scene.boundary)() and not isinstance(scene.geometry, Journal)
    if ambient and scene.motion.speed > 0 and value["friction_per_width"] < scene.boundary_friction * contact:
        yield f"friction {value['friction_per_width']:.6g} N/m is less than that of the asperities alone"
