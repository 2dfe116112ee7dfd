"""The first-order estimate of inertia, which all models of a bearing leave out."""

from roughfilm.rom.bearing.effects.inertia import inertia_obstacle
from roughfilm.rom.bearing.equilibrium.expected import expected_film, expected_scene
from roughfilm.rom.bearing.inertia import inertia
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.solve import load_loops, solve
from roughfilm.rom.ladder.kind import Omission

CELLS = {True: 512, False: 64}
"""Number of cells along a side, for an infinitely wide film (True) and for others."""

FILM = "film_min"

MIN_STEEPNESS = 0.5
"""Smallest exponent of the load over the film thickness by which a change of the load is divided."""

INERTIA_FIELDS = {"load_per_width": "load", "friction_per_width": "friction"}


def _of_film(scene: Bearing) -> Omission | None:
    """The change of the film thickness under a load: that of the load at a given film over the steepness."""
    expected = expected_film(scene)
    of_load = inertia_omitted(scene.at_film(expected.thickness), "load_per_width")
    if of_load is None:
        return None
    part = of_load.part / max(expected.steepness, MIN_STEEPNESS)
    reason = f"{of_load.reason} at a given film, and the film under the load by about {100 * part:.2g} %"
    return Omission(part=part, reason=reason)


def inertia_omitted(scene: Bearing, quantity: str) -> Omission | None:
    """The relative change of load or friction of the smooth film by inertia; None where it cannot be estimated.

    Raises
    ------
    ConvergenceError
        If the film does not converge.
    """
    if inertia_obstacle(scene) is not None or quantity not in (*INERTIA_FIELDS, FILM):
        return None
    if quantity == FILM:
        return None if scene.load is None else _of_film(scene)
    scene = expected_scene(scene)
    load_loops(scene.wide)
    solution = solve(scene.problem(), (CELLS[scene.wide],) * 2)
    width = 1.0 if scene.geometry.width is None else scene.geometry.width
    size = abs(bearing_quantities(scene, solution)[quantity].value)
    fraction = abs(getattr(inertia(scene, solution), INERTIA_FIELDS[quantity])) / width / size if size > 0 else 0.0
    number = bearing_numbers(scene)["reduced_reynolds_number"]
    change = f"by about {100 * fraction:.2g} %" if fraction < 1 else "by more than the first-order estimate can predict"
    return Omission(
        part=fraction,
        reason=f"reduced Reynolds number Re·h/L = {number:.2g}: inertia, which no model of a bearing includes, "
        f"changes the {INERTIA_FIELDS[quantity]} {change}",
    )
