"""What a motion in time means for a scene: whether films at rest are enough, and by which film models are judged."""

import math

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.equilibrium.expected import expected_film
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.journals import opened, with_coordinates
from roughfilm.rom.bearing.march.on_path import PathLoads, loads_on_path
from roughfilm.rom.bearing.march.quasi_static import CELLS, TIMES, marched_change, quasi_static
from roughfilm.rom.bearing.moving.checks import MOMENTS
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.kind import InTime

MAX_CHANGE = 0.3
"""Relative change up to which the estimate to first order is stated as a number where no march does."""

APPROACH_CELLS = {True: 512, False: 48}
"""Number of cells along a side of the films with and without an approach, infinitely wide (True) and others."""

AT_REST = 1e-6
"""Speed over the largest one below which a wall that slides back and forth is at rest."""

LOADS, SPEEDS, PATH, APPROACH = "load over time", "speed over time", "path over time", "approach"
"""The beginnings of the sentences."""

MISSING = {
    LOADS: "not every load has a film in equilibrium",
    SPEEDS: "not every speed has a film in equilibrium",
    PATH: "not every place has a film at rest",
}
"""Why squeeze is not compared with films without it."""

JUDGED = {
    LOADS: "models are judged at the largest load",
    SPEEDS: "models are judged at the least film",
    PATH: "models are judged at the largest load",
}
"""The time at which models are judged."""


def in_time(scene: Bearing, within: float) -> InTime | None:
    """What the motion of a scene means: whether squeeze matters, and the rates from which on it does.

    Parameters
    ----------
    within : tolerated relative error of the least film under a load, or of the load at a given film.

    Returns
    -------
    InTime or None
        None if nothing moves the walls towards each other.
    """
    given = _given(scene)
    if given is None:
        return None
    if given == APPROACH:
        return _of_approach(scene, within)
    try:
        duty = Duty(scene=with_coordinates(scene, CELLS))
        if given == PATH:
            found = loads_on_path(duty)
            if not found.carries_at_rest:
                return _alone(given, "squeeze alone gives the film its load; take roughfilm march")
            return _stated(given, "load", found.change, found.squeeze_number, within)
        moved = quasi_static(duty)
        try:
            marched, stop = marched_change(duty), None
        except ConvergenceError as error:
            marched, stop = None, error
    except (InputError, ConvergenceError) as error:
        return _alone(given, f"{MISSING[given]} ({error}); take roughfilm march")
    return _stated(given, "least film", moved.change, moved.squeeze_number, within, marched, stop)


def _alone(given: str, words: str) -> InTime:
    """The sentences on a motion whose films are not compared with films at rest."""
    judged = (f"{given}: {JUDGED[given]}",) if given in JUDGED else ()
    return InTime(lines=(f"{given}: {words}", *judged), entries={"quasi_static": None})


def _given(scene: Bearing) -> str | None:
    """What moves the walls of a scene towards each other; None if nothing does."""
    table = scene.motion.over_time
    if table is None:
        return APPROACH if scene.motion.approach else None
    columns = table.table.columns.keys()
    if {"load", "load_x", *MOMENTS} & columns:
        return LOADS
    if {"film", "eccentricity_x"} & columns:
        return PATH
    return SPEEDS if "speed" in columns and scene.load is not None else None


def _stated(
    given: str,
    quantity: str,
    change: float,
    number: float,
    within: float,
    marched: float | None = None,
    stop: ConvergenceError | None = None,
) -> InTime:
    """The sentences and entries on a change by squeeze.

    Where a march has too many steps, the estimate to first order says whether films at rest are enough.

    Parameters
    ----------
    change : relative change of the quantity, to first order in the rates.
    number : squeeze number, infinite if it is unknown.
    marched : relative change by a march on a coarse grid.
    stop : the error that stopped this march.
    """
    stated, larger = change if marched is None else marched, max(abs(change), abs(marched or 0.0))
    rate, known = within / larger if larger else math.inf, marched is not None or abs(change) <= MAX_CHANGE
    enough = abs(stated) <= within and (stop is None or stop.outcome is Outcome.UNFINISHED)
    if marched is not None:
        size = f"by {100 * marched:+.2g} %"
    elif known:
        size = f"by up to about {100 * abs(change):.2g} %"
    else:
        size = f"possibly by more than {100 * MAX_CHANGE:g} %"
    by = "" if stop is None else f", to first order, as a march on a coarse grid stops ({stop})"
    shown = "" if math.isinf(number) else f" (squeeze number {number:.2g})"
    films = {LOADS: "films in equilibrium with each load", SPEEDS: "films in equilibrium at each speed"}.get(
        given, "films at rest at each place"
    )
    verdict = (
        f"are enough for {100 * within:g} %"
        if enough
        else f"are not enough for {100 * within:g} %, take roughfilm march"
    )
    limit = (
        "at any rate of change"
        if math.isinf(rate)
        else f"up to about {max(rate, 1.0):.2g} times the rates of this table"
        if enough
        else f"below about {min(rate, 1.0):.2g} times the rates of this table they would be"
    )
    return InTime(
        lines=(
            f"{given}: squeeze changes the {quantity} {size}{by}{shown}",
            f"{given}: {films} {verdict}; {limit}",
            f"{given}: {JUDGED[given]}",
        ),
        entries={
            "quasi_static": {
                "enough": enough,
                f"change_of_{quantity.replace(' ', '_')}": stated if known else None,
                "marched": marched is not None,
                "squeeze_number": None if math.isinf(number) else number,
                "largest_rate_factor": None if math.isinf(rate) else rate,
            }
        },
    )


def _of_approach(scene: Bearing, within: float) -> InTime:
    """The sentences on a given approach of the walls: the film with it beside that of walls at rest."""
    loaded, approach = scene.load is not None, scene.motion.approach
    quantity = "least film" if loaded else "load"
    if scene.motion.speed == 0 and not scene.supply:
        return _alone(
            APPROACH, f"squeeze alone gives the film its pressure; its {quantity} follows the rate of approach"
        )
    try:
        with_it, without = (_carried(one) for one in (scene, _at_rest(scene)))
    except (InputError, ConvergenceError) as error:
        return _alone(APPROACH, f"walls at rest have no such film ({error}); the approach is needed")
    if without <= 0:
        return _alone(APPROACH, "without it the film carries no load; the approach is needed")
    change = with_it / without - 1
    enough = abs(change) <= within
    size = f"by {100 * change:+.2g} %" if abs(change) <= MAX_CHANGE else f"to {with_it / without:.2g} times"
    rate = within / abs(change) * abs(approach) if change else math.inf
    moved = f"up to about {rate:.2g} m/s" if enough else f"below about {rate:.2g} m/s it may be"
    verdict = "may be left out" if enough else "may not be left out"
    return InTime(
        lines=(
            f"approach: squeeze at {abs(approach):.3g} m/s changes the {quantity} {size}",
            f"approach: it {verdict} for {100 * within:g} %; {moved}",
        ),
        entries={
            "quasi_static": {
                "enough": enough,
                f"change_of_{quantity.replace(' ', '_')}": change,
                "largest_approach": None if math.isinf(rate) else rate,
            }
        },
    )


def _at_rest(scene: Bearing) -> Bearing:
    """The scene without an approach."""
    return scene.model_copy(update={"motion": scene.motion.model_copy(update={"approach": 0.0})})


def _carried(scene: Bearing) -> float:
    """The film under the load of a scene, m, or the load per width of its film, N/m, on a coarse grid."""
    if scene.load is not None:
        return expected_film(scene).thickness
    solution = solve(scene.problem(), (APPROACH_CELLS[scene.wide],) * 2)
    return bearing_quantities(scene, solution)["load_per_width"].value


def steady(scene: Bearing) -> Bearing:
    """The scene at the time by which models are judged, without a table over time.

    It is that of the largest load, with the load, its direction and the speed then; for a given load that of the least
    film. On a path it is the place of the largest load, with the approach of a wall that moves along its normal.
    """
    given = _given(scene)
    if given in (None, APPROACH):
        return scene
    duty = Duty(scene=opened(scene) if given == LOADS else with_coordinates(scene, CELLS))
    table = scene.motion.over_time
    assert table is not None
    if given == PATH:
        return _on_path(scene, duty, loads_on_path(duty))
    if given == SPEEDS:
        found = quasi_static(duty)
        at = float(found.time[int(np.argmin(found.film_min))])
    else:
        times = np.linspace(table.table.time[0], table.table.time[-1], 20 * TIMES + 1)
        at = float(max(times, key=lambda time: float(np.linalg.norm(duty.load(time)[: 2 if duty.lobes else 1]))))
        if duty.reverses and abs(duty.speed(at)) <= AT_REST * max(abs(duty.speed(float(time))) for time in times):
            raise InputError(
                f"motion.over_time.speed: got {duty.speed(at):.4g} m/s at {at:.4g} s with the largest load, which no "
                "steady film carries then; take roughfilm march, or another speed then"
            )
    motion = scene.motion.model_copy(update={"speed": duty.sliding_speed(at), "over_time": None})
    return scene.model_copy(update={"load": duty.steady_load(at), "motion": motion, "body": None})


def _on_path(scene: Bearing, duty: Duty, found: PathLoads) -> Bearing:
    """The scene at the place of a path at which the load is largest."""
    number = found.largest
    geometry, place = scene.geometry, found.place[number]
    speed = duty.sliding_speed(float(found.time[number]))
    motion = scene.motion.model_copy(update={"speed": speed, "over_time": None})
    if isinstance(geometry, MovingWall):
        moved = scene.moved(geometry.at(place))
    elif isinstance(geometry, Journal):
        moved = scene.at_film(geometry.clearance - float(np.hypot(*place[:2])))
    else:
        moved = scene.at_film(float(place[0]))
        motion = motion.model_copy(update={"approach": -float(found.velocity[number, 0])})
    return moved.model_copy(update={"motion": motion, "body": None})
