"""The map of shafts that move freely: their equilibrium in lobes, and their motion in time."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import product
from statistics import median
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.ladder import find
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm, free_film
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.quantities import load_of, shaft_force
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.motion.march import Course, Moving, begun, march
from roughfilm.rom.cavitation.solve import solve as given_film
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.stability.form import (
    BAD,
    Judgement,
    MapOutcome,
    Probe,
    Spot,
    StabilityMap,
    count,
    in_groups,
    in_numbers,
    in_turn,
    listed,
)

MODEL = "reynolds_cavitating"

SAME_PLACE = 1e-5
"""Difference of two places over the least film below which they are the same."""

LOAD_TOLERANCE = 1e-6
"""Allowed relative error of the load of a film that another solver finds at the place that was found."""

LINE_REFINEMENT = 4
"""Cells of an infinitely wide film over those of a film with a width."""

TURNED = math.radians(-75)
"""Direction from the x axis in which the shaft stands, rad: not that of a middle of a lobe."""

ECCENTRICITIES = (0.1, 0.3, 0.6, 0.8, 0.9, 0.95, 0.99)
"""1 - h/h₀ with the least film h and that of a centred shaft, h₀."""

WIDTHS = (0.25, 1.0, math.inf)
"""Widths over the diameter."""

BORE: Mapping[str, Any] = {"shape": "lobes", "radius": "25 mm", "clearance": "25 um"}

BORES: Mapping[str, Mapping[str, Any]] = {
    "full bore": {},
    "partial arc of 150°": {"arc": "150 deg"},
    "two axial grooves": {"lobes": 2, "arc": "160 deg"},
    "two lobes, preload 0.5": {"lobes": 2, "arc": "160 deg", "preload": 0.5},
    "three lobes without gaps, preload 0.5": {"lobes": 3, "preload": 0.5},
    "three offset lobes, preload 0.7": {"lobes": 3, "arc": "100 deg", "preload": 0.7, "offset": 0.8},
    "four tilting pads": {"lobes": 4, "arc": "80 deg", "first": "-45 deg", "preload": 0.3, "pivot": 0.5},
    "five tilting pads": {"lobes": 5, "arc": "60 deg", "preload": 0.4, "pivot": 0.6, "offset": 0.6},
}
"""The bores of the map; a bore without gaps is fed at 0.2 MPa through its sides."""

JUMPS = (0.1, 0.5, 2.0, 5.0, 20.0)
"""Loads after a jump over those before it."""

STEPS = (1.0, 0.2, 0.05, 0.01)
"""Largest time steps over the time of a turn."""

APPROACHES = (0.1, 1.0, 10.0, 100.0)
"""Velocities of a shaft over the velocity of its clearance times the angular velocity."""

STEP_ERROR = 1e-3
"""Allowed relative error of a time step."""

REFERENCE_ERROR = 1e-6
"""The same of the motion to which others are compared."""

FORCE_ERROR = 0.01
"""Allowed relative difference of the force at the end of a given motion."""

FILM_RESIDUAL = 1e-9
"""Residual at which the films of motions are solved."""


def shaft(bore: Mapping[str, Any], width: float = 1.0, **tables: Any) -> Bearing:
    """A shaft that turns 1500 times a minute in a bore, of a width over its diameter."""
    geometry = {**BORE, **bore, **({} if math.isinf(width) else {"width": f"{width * 50e-3!r} m"})}
    joined = "arc" not in bore
    entries = {
        "name": "a shaft",
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": {"viscosity": "20 mPa*s"},
        "motion": {"speed": "1500 rpm"},
        **({"boundary": {"sides": {"low": "0.2 MPa", "high": "0.2 MPa"}}} if joined else {}),
        **tables,
    }
    scene = read_scene(entries)
    assert isinstance(scene, Bearing)
    return scene


@dataclass(frozen=True, kw_only=True)
class Found:
    """The place of a shaft that a search found under the load of a known place.

    Attributes
    ----------
    apart : distance of the place from the known one over the least film.
    again : error of the load that the independent solver finds at this place, over the load; None in bores with gaps.
    idle : whether a pad carries no load at the known place, which then is not the only one.
    known, film, finer : least film at the known place, at the found one, and on cells half as large, m.
    uncertainty : uncertainty of the first as the result states it, m; None if it is unknown.
    iterations : Newton steps on all grids.
    """

    apart: float
    again: float | None
    idle: bool
    known: float
    film: float
    finer: float
    uncertainty: float | None
    iterations: int


def found(bore: Mapping[str, Any], width: float, eccentricity: float, cells: int) -> Found:
    """Solve for the load of a shaft at a known place, then search the place under this load, on two grids."""
    resolution = cells * (LINE_REFINEMENT if math.isinf(width) else 1)
    room = 1 - float(bore.get("preload", 0.0))
    toward = (math.cos(TURNED), math.sin(TURNED))
    first = shaft({**bore, "eccentricity": [1e-3 * one for one in toward]}, width)
    known = first.moved(first.geometry.at_film((1 - eccentricity) * room * 25e-6))
    assert isinstance(known.geometry, Lobes)
    assert known.geometry.eccentricity is not None
    solver = find("bearing", MODEL)
    given = solver.solve(known, Request(resolution=resolution))
    push = pushed(known, given.fields)
    angle = math.degrees(math.atan2(-push[1], -push[0]))
    load = math.hypot(*push)
    key, unit = ("force_per_width", "N/m") if math.isinf(width) else ("force", "N")
    loaded = shaft(bore, width, load={key: f"{load!r} {unit}", "angle": f"{angle!r} deg"})
    result = solver.solve(loaded, Request(resolution=resolution))
    finer = solver.solve(loaded, Request(resolution=2 * resolution))
    place = np.array([result["eccentricity_x"].value, result["eccentricity_y"].value])
    film = result["film_min"].value
    apart = float(np.hypot(*(place - np.array(known.geometry.eccentricity)))) * known.geometry.clearance / film
    return Found(
        apart=apart,
        again=_again(loaded, place, load, resolution),
        idle=any("no load" in warning for warning in given.warnings),
        known=given["film_min"].value,
        film=film,
        finer=finer["film_min"].value,
        uncertainty=result["film_min"].uncertainty,
        iterations=result.numerics.iterations,
    )


def pushed(scene: Bearing, fields: Mapping[str, Any]) -> tuple[float, float]:
    """The force on a shaft along x and y by the pressure of a result, N (N/m if infinitely wide)."""
    geometry = scene.geometry
    assert isinstance(geometry, Lobes)
    x, y = fields["x"].values[:, 0], fields["y"].values[0]
    lengths = _lengths(x, None if geometry.single else geometry.length)
    across = np.ones(1) if y.size == 1 else _lengths(y, None)
    return shaft_force(geometry, x, lengths[:, None] * across * fields["pressure"].values)


def _lengths(places: Array, period: float | None) -> Array:
    """The lengths of the control volumes around nodes."""
    if period is not None:
        places = np.concatenate([[places[-1] - period], places, [places[0] + period]])
        return np.asarray((places[2:] - places[:-2]) / 2)
    steps = np.diff(places)
    return np.asarray((np.append(steps, 0) + np.append(0, steps)) / 2)


def _again(scene: Bearing, place: Array, load: float, cells: int) -> float | None:
    """The error of the load of the film at a place by the solver of given films, over the load; None with gaps."""
    geometry = scene.geometry
    assert isinstance(geometry, Lobes)
    if not geometry.joined:
        return None
    moved = scene.moved(geometry.at(place * geometry.clearance))
    film = given_film(moved.problem(), (cells, cells // 2), tolerance=1e-10)
    pressure = film.state.pressure + scene.lubricant.cavitation_pressure
    return load_of(moved, film.grid.x, film.grid.areas * pressure) / load - 1


def judged(answer: Found) -> Judgement:
    """The judgement of a place by the known one, by another solver, and by a finer grid.

    Where a pad carries no load at the known place, another place with a thicker film is right too.
    """
    faults = []
    other = answer.apart > SAME_PLACE and answer.idle and answer.film > answer.known
    if answer.apart > SAME_PLACE and not other:
        faults.append(f"the shaft is {answer.apart:.3g} of the least film from the known place")
    if answer.again is not None and abs(answer.again) > LOAD_TOLERANCE:
        faults.append(f"another solver finds a load that differs by {answer.again:.3g}")
    error = abs(answer.finer / answer.film - 1)
    reported = not faults and answer.uncertainty is None
    if answer.uncertainty is None:
        faults.append("the coarser grid has no equilibrium, so that the uncertainty is unknown")
    elif abs(answer.finer - answer.film) > answer.uncertainty:
        bar = answer.uncertainty / answer.film
        faults.append(f"the film differs from that on a finer grid by {error:.3g}, its uncertainty is {bar:.3g}")
    return Judgement(
        iterations=answer.iterations,
        right=not faults,
        reported=reported,
        error=error,
        numbers={"apart": answer.apart, "film": answer.film},
        message="; ".join(faults) or "another place, at which more pads carry the load" * other,
    )


@dataclass(frozen=True, kw_only=True)
class Moved:
    """The end of a motion.

    Attributes
    ----------
    error : difference from the end of the motion by short steps, over its scale.
    allowed : largest difference that the error of the steps allows.
    steps : number of steps.
    iterations : Newton steps of all steps.
    """

    error: float
    allowed: float
    steps: int
    iterations: int


@cache
def _film(cells: int) -> tuple[FreeFilm, Instant]:
    """A shaft between two axial grooves at rest under its load, at an eccentricity of about 0.5."""
    scene = shaft(BORES["two axial grooves"], load={"force": "2 kN"})
    film = free_film(scene, (cells, cells // 2))
    return film, equilibrium(film, None, tolerance=FILM_RESIDUAL)


def _course(film: FreeFilm, jump: float) -> Course:
    """The motion without mass after a jump of the load."""
    count = film.load.size
    nothing = np.zeros((count, count))
    return Course(
        free=np.ones(count, dtype=bool),
        place=lambda _: np.zeros(count),
        speed=lambda _: film.solved.problem.speed,
        force=lambda _: jump * film.load,
        mass=nothing,
        stiffness=nothing,
        velocity_scale=_rate(film) * film.wall.unit,
    )


def _rate(film: FreeFilm) -> float:
    """The angular velocity of the shaft, rad/s."""
    return 2 * math.pi * film.scene.revolutions


def _end(film: FreeFilm, course: Course, start: Instant, end: float, largest: float, error: float) -> list[Moving]:
    return [
        *march(
            film.solved,
            course,
            begun(film.solved, start),
            end,
            largest_step=largest,
            error=error,
            tolerance=FILM_RESIDUAL,
            closest=1e-4 * float(film.wall.unit[0]),
        )
    ]


@cache
def _reference(cells: int, jump: float) -> Array:
    """The place of the shaft a turn after a jump of its load, by short steps."""
    film, start = _film(cells)
    turn = 2 * math.pi / _rate(film)
    return _end(film, _course(film, jump), start, turn, turn / 50, REFERENCE_ERROR)[-1].now.place


def after_jump(jump: float, step: float, cells: int) -> Moved:
    """The place a turn after a jump of the load, by steps of at most a fraction of a turn."""
    film, start = _film(cells)
    turn = 2 * math.pi / _rate(film)
    path = _end(film, _course(film, jump), start, turn, step * turn, STEP_ERROR)
    apart = np.abs(path[-1].now.place - _reference(cells, jump)) / film.wall.unit
    return Moved(
        error=float(apart.max()),
        allowed=STEP_ERROR * 2 * math.pi * step * len(path),
        steps=len(path),
        iterations=sum(one.instant.iterations for one in path),
    )


def settled_again(jump: float, step: float, cells: int) -> Moved:
    """The place 20 turns after a jump of the load, against the equilibrium under the new load."""
    film, start = _film(cells)
    turn = 2 * math.pi / _rate(film)
    path = _end(film, _course(film, jump), start, 20 * turn, step * turn, STEP_ERROR)
    rest = equilibrium(film, None, tolerance=FILM_RESIDUAL, load=jump * film.load)
    apart = np.abs(path[-1].now.place - rest.place) / film.wall.unit
    return Moved(
        error=float(apart.max()),
        allowed=STEP_ERROR * 2 * math.pi * step * len(path),
        steps=len(path),
        iterations=sum(one.instant.iterations for one in path),
    )


def squeezed(approach: float, step: float, cells: int) -> Moved:
    """The force on a shaft that moves 0.4 of its clearance towards the load at a given velocity.

    ``step`` is a fraction of the time of this motion. The velocity rises and falls as a sine.
    """
    film, start = _film(cells)
    clearance = float(film.wall.unit[0])
    way = 0.4 * clearance * film.load / float(np.hypot(*film.load))
    time = 0.4 / (approach * _rate(film))

    def place(t: float) -> Array:
        return np.asarray(start.place + way * (t / time - math.sin(2 * math.pi * t / time) / (2 * math.pi)))

    course = replace(_course(film, 1.0), free=np.zeros(film.load.size, dtype=bool), place=place)
    course = replace(course, velocity_scale=np.full(film.load.size, approach * _rate(film) * clearance))
    forces = []
    for largest, error in ((step, STEP_ERROR), (0.01, STEP_ERROR / 100)):
        path = _end(film, course, start, 0.6 * time, largest * time, error)
        forces.append((film.solved.force(path[-1].instant.state.pressure), path))
    (force, path), (reference, _) = forces
    return Moved(
        error=float(np.hypot(*(force - reference)) / np.hypot(*reference)),
        allowed=FORCE_ERROR,
        steps=len(path),
        iterations=sum(one.instant.iterations for one in path),
    )


def judged_motion(answer: Moved) -> Judgement:
    """The judgement of a motion by that with short steps."""
    right = answer.error <= answer.allowed
    return Judgement(
        iterations=round(answer.iterations / answer.steps),
        right=right,
        error=answer.error,
        numbers={"steps": float(answer.steps), "iterations_of_all": float(answer.iterations)},
        message="" if right else f"the difference is {answer.error:.3g}, above {answer.allowed:.3g}",
    )


REFUSED: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]] = {
    "a load away from a partial arc": ({"arc": "150 deg"}, {"load": {"force": "1 kN", "angle": "90 deg"}}),
    "a load above that of the thinnest film": (BORES["two axial grooves"], {"load": {"force": "1e9 N"}}),
    "no sliding": (BORES["two axial grooves"], {"motion": {"speed": "0 m/s"}}),
    "a shaft outside of its bore": ({**BORES["two axial grooves"], "eccentricity": [0.9, -0.9]}, {}),
    "misalignment beyond the clearance": (
        {**BORES["two axial grooves"], "eccentricity": [0.0, -0.5], "misalignment": ["2 mrad", "0 rad"]},
        {},
    ),
}
"""Shafts without an equilibrium, or in no bore: bore and other tables; the load is 1 kN unless a place is given."""


def _solved(bore: Mapping[str, Any], tables: Mapping[str, Any], cells: int) -> object:
    load = {} if "eccentricity" in bore else {"load": {"force": "1 kN"}}
    return find("bearing", MODEL).solve(shaft(bore, 1.0, **{**load, **tables}), Request(resolution=cells))


def probes(cells: int) -> Iterator[Probe]:
    """The probes of equilibria and motions on ``cells`` along the film, and of shafts that must be refused."""
    for (name, bore), width, eccentricity in product(BORES.items(), WIDTHS, ECCENTRICITIES):
        if math.isinf(width) and "arc" not in bore:
            continue
        ask = partial(found, bore, width, eccentricity, cells)
        row, column = f"B/D = {width:g}", f"ε = {eccentricity:g}"
        yield Probe(group=name, row=row, column=column, ask=ask, judge=judged)
    for jump, step in product(JUMPS, STEPS):
        row, column = f"load × {jump:g}", f"step ≤ {step:g} turns"
        turn = partial(after_jump, jump, step, cells)
        yield Probe(group="a turn after a jump of the load", row=row, column=column, ask=turn, judge=judged_motion)
    for jump, step in product(JUMPS, STEPS[:2]):
        row, column = f"load × {jump:g}", f"step ≤ {step:g} turns"
        later = partial(settled_again, jump, step, cells)
        group = "twenty turns after a jump of the load"
        yield Probe(group=group, row=row, column=column, ask=later, judge=judged_motion)
    for approach, step in product(APPROACHES, STEPS[1:]):
        row, column = f"v/(cω) = {approach:g}", f"step ≤ {step:g} of the motion"
        moved = partial(squeezed, approach, step, cells)
        yield Probe(group="a shaft that is moved", row=row, column=column, ask=moved, judge=judged_motion)
    for name, (bore, tables) in REFUSED.items():
        refused = partial(_solved, bore, tables, cells)
        yield Probe(group="no equilibrium", row=name, column=MODEL, ask=refused, judge=judged, refused=True)


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: each group, and the number of Newton steps."""
    lines = []
    for name, own in in_groups(spots).items():
        if steps := [spot.iterations for spot in own if spot.iterations is not None]:
            lines.append(f"{name}: {in_numbers(own)}; {median(steps):g} Newton steps (median), at most {max(steps)}.")
    lines.append(f"{count(spots, MapOutcome.REFUSED)} shafts without an equilibrium are refused.")
    return [*lines, *listed(spots, *BAD)]


MOTION = StabilityMap(
    name="motion",
    title="Shafts that move freely",
    axes="Bores with full and partial arcs, lobes and tilting pads (groups) of several widths (rows): "
    f"{MODEL} gives the load of a shaft at a known place (columns: 1 - h/h₀ with the least film h and that of a "
    "centred shaft, h₀), and searches the place under this load as a vector, on {resolution} cells along the film. "
    "Then motions of a shaft without mass between two axial grooves: after a jump of its load, and at a given "
    "velocity. Then shafts without an equilibrium.",
    judge=f"The known place, which must come back to {SAME_PLACE:g} of the least film, or, where a pad carries no load "
    "there, another place with a thicker film; in bores without gaps the load of this place by the solver of given "
    f"films, which may differ by {LOAD_TOLERANCE:g}; and the least film on cells half as large, from which it may "
    "differ by its uncertainty, and which gives the error; it is inaccurate where the uncertainty is unknown. Motions "
    f"are compared with those by steps {STEP_ERROR / REFERENCE_ERROR:g} times as exact: the place may differ by the "
    f"allowed error of all steps, the force by {FORCE_ERROR:.0%}; after twenty turns the place is that of the "
    "equilibrium. Iterations are Newton steps, of a motion those of a time step.",
    resolution=48,
    resolution_meaning="cells along the film, with half as many across",
    least=48,
    most=128,
    allowed="the films take 48 to 128 cells along",
    solve=in_turn(probes),
    summary=summary,
)
