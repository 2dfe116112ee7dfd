"""The equilibrium of a wall that moves freely: the steady state of a motion with long time steps."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.free.closed import closed, starved, touching
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.free.idle import idle_pads, with_wedges
from roughfilm.rom.bearing.free.unbalanced import remedy, unbalanced
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.cavitation.interpolation import carried
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, kinds, settled
from roughfilm.rom.cavitation.motion.past import held
from roughfilm.rom.cavitation.problem import unchanging

FIRST_STEP = 0.2
"""First time step over the time in which the shaft turns by a radian."""

GROWTH = 4.0
"""Ratio of successive time steps that converge."""

LAST_STEP = 1e6
"""Time step over that time from which on the equilibrium itself is solved."""

MAX_STEPS = 200
"""Largest number of time steps."""

MAX_RESTARTS = 8
"""Largest number of times that pads which carry no load are tilted anew on the way to an equilibrium."""

HOLDING = 1e-6
"""Stiffness that holds a shaft at its place before a step, over the load per clearance."""

ALIGNING = 1e-7
"""Stiffness that aligns pads with the shaft, over η u B (R/c)² per clearance; at rest over the load per clearance."""

MAX_MOVE = 0.25
"""Largest move of a shaft or of the edge of a pad in a step, over the clearance and its distance."""

SHORT_STEP = 1e-3
"""Time step over that time up to which a longer move is not refused: nothing resists a shaft that leaves a film."""

SETTLED = 1e-4
"""Move in the last step, over the clearance, up to which the motion has ended."""

FARTHEST = 100.0
"""Distance of the shaft from the middle of its bore over the clearance beyond which no equilibrium is sought."""

UNRESISTED = 1e-9
"""Force of the film over the load below which it does not resist the load."""


def equilibrium(film: FreeFilm, start: Instant | None, *, tolerance: float, load: Array | None = None) -> Instant:
    """The film at which the load of the scene and the force of the film balance.

    It is the end of a motion without mass by backward Euler steps, each ``GROWTH`` times as long as the one before.
    From a start that is near enough, the first step is that of a steady film. If tilting pads have two equilibria, it
    is the one in which fewer pads are idle.

    Parameters
    ----------
    start : a film near the equilibrium; without one, or if its walls meet between the nodes of a coarser grid, the
        shaft starts at rest in its middle.
    tolerance : residual at which a film is solved.
    load : the load on each coordinate, N; by default that of the scene.

    Raises
    ------
    InputError
        If the film closes, the shaft leaves its bore, or the film starves a supply in equilibrium.
    ConvergenceError
        If the motion does not settle.
    """
    solved = film.solved
    force = film.load if load is None else load
    if (reason := unbalanced(film, force)) is not None:
        raise reason
    if start is not None and solved.room(start.place) <= 0:
        start = None
    if start is not None:
        near, last = start, MAX_MOVE
        while last > SETTLED:
            try:
                instant = _moved(film, near, force, 0.0, tolerance)
            except (ConvergenceError, FloatingPointError):
                break
            if starved(film, instant) is not None:
                break
            move = _move(film, near, instant)
            if move > last:
                break
            near, last = instant, min(move, 0.5 * last)
        else:
            if closed(film, near, force) is None and touching(film, near) is None:
                return _with_loaded_pads(film, near, force, tolerance)
    if start is None:
        start = film.first(film.wall.place)
        constant = unchanging(solved.problem)
        if constant != solved.problem and film.free.any():
            simple = replace(film, solved=replace(solved, problem=constant))
            start = _settling(simple, start, force, tolerance)
    try:
        end = _settling(film, start, force, tolerance)
    except (InputError, ConvergenceError):
        if (first := _without_suction(film, force, tolerance)) is None:
            raise
        end = _settling(film, first, force, tolerance, restarts=0)
    return _with_loaded_pads(film, end, force, tolerance)


def _without_suction(film: FreeFilm, force: Array, tolerance: float) -> Instant | None:
    """A film at the equilibrium of tilting pads with cavities at ambient pressure, if all pads carry load there.

    Idle pads may be drawn onto the shaft on the way, while at the end no film of a pad cavitates much.
    """
    solved, geometry, suction = film.solved, film.scene.geometry, film.solved.ambient
    if suction <= 0 or not isinstance(geometry, Lobes) or not film.free[film.wall.turns].any():
        return None
    ends = solved.problem.ends
    inlet = None if ends.inlet is None else ends.inlet - suction
    sides = None if ends.sides is None else (ends.sides[0] - suction, ends.sides[1] - suction)
    problem = replace(
        solved.problem, ends=replace(ends, inlet=inlet, outlet=max(ends.outlet - suction, 0.0), sides=sides)
    )
    inflows = tuple(replace(one, pressure=one.pressure - suction) for one in solved.inflows)
    scene = film.scene.model_copy(
        update={"lubricant": film.scene.lubricant.model_copy(update={"cavitation_pressure": 0.0})}
    )
    at_ambient = replace(
        film,
        scene=scene,
        whole=replace(film.whole, inflows=inflows, ambient=0.0),
        solved=replace(solved, problem=problem, inflows=inflows, ambient=0.0),
    )
    try:
        found = equilibrium(at_ambient, None, tolerance=tolerance, load=force)
    except (InputError, ConvergenceError):
        return None
    return None if idle_pads(at_ambient, found) else film.first(found.place)


def _with_loaded_pads(film: FreeFilm, instant: Instant, force: Array, tolerance: float) -> Instant:
    """The equilibrium in which fewer pads are idle than at another one, if there is one; else that one."""
    while idle := idle_pads(film, instant):
        start = with_wedges(film, instant, idle, tolerance=tolerance)
        if start is None:
            break
        try:
            other = _settling(film, start, force, tolerance)
        except (InputError, ConvergenceError):
            break
        if len(idle_pads(film, other)) >= len(idle):
            break
        instant = other
    return instant


def _settling(film: FreeFilm, start: Instant, force: Array, tolerance: float, restarts: int = MAX_RESTARTS) -> Instant:
    """The end of the motion without mass from a film.

    At rest the last step may be a long one: nothing determines how far the cavities of a steady film would be filled.
    Where a pad that carries no load closes on the way, the motion goes on from a tilt at which it carries one.
    """
    solved, count, speed = film.solved, force.size, film.solved.problem.speed
    time, shaft = 1 / _rate(film), isinstance(film.scene.geometry, Shaft)
    step = FIRST_STEP * time
    given = Drive(
        speed=speed,
        force=force,
        stiffness=np.zeros((count, count)),
        free=np.zeros(count, dtype=bool),
        storage=(0.0, 0.0) if speed or not film.free.any() else (1 / time, held(solved, start) / time),
    )
    moves, failed = bool(film.free.any()), None
    try:
        instant = settled(solved, start, given, tolerance=tolerance, starved=moves)
    except ConvergenceError as error:  # in time the cavities fill
        instant, failed = start, error
    if not moves and failed is None:
        return instant
    for _ in range(MAX_STEPS):
        last = step >= LAST_STEP * time
        following = None
        for rate in ((0.0,) if speed else (0.0, 1 / step)) if last else (1 / step,):
            try:
                following = _moved(film, instant, force, rate, tolerance)
            except (ConvergenceError, FloatingPointError):
                continue
            break
        if following is None and failed is not None and (not moves or instant is start):
            raise failed
        move = np.inf if following is None else _move(film, instant, following)
        if following is None or (move > MAX_MOVE and step > SHORT_STEP * time):
            step /= GROWTH**2
            if step < 1e-6 * time:
                break
            continue
        instant = following
        if moves and (reason := closed(film, instant, force)) is not None:
            idle = idle_pads(film, instant) if restarts else []
            wedges = with_wedges(film, instant, idle, tolerance=tolerance) if idle else None
            if wedges is None or solved.room(wedges.place) <= solved.room(instant.place):
                raise reason
            return _settling(film, wedges, force, tolerance, restarts - 1)
        if last and move <= SETTLED:
            if (refused := starved(film, instant) or touching(film, instant)) is not None:
                raise refused
            return instant
        if shaft and float(np.hypot(*instant.place[:2])) > FARTHEST * film.wall.unit[0]:
            raise _leaves(force)
        step *= GROWTH
    if shaft and np.hypot(*solved.force(instant.state.pressure)[:2]) <= UNRESISTED * np.hypot(*force[:2]):
        raise _leaves(force)
    idle, more = idle_pads(film, instant), ""
    if idle and film.scene.lubricant.cavitation_pressure < 0:
        more = f"; suction acts on pad {idle[0] + 1}, which carries no load; try cavitation at ambient pressure"
    raise ConvergenceError(
        f"load: the motion towards the equilibrium does not settle; {remedy(film.scene)}{more}",
        outcome=Outcome.STALLED,
        iterations=MAX_STEPS,
    )


def _moved(film: FreeFilm, instant: Instant, force: Array, rate: float, tolerance: float) -> Instant:
    """The film after a step of backward Euler of the length 1/rate, s; in equilibrium for the rate 0."""
    solved, held_by, aligned_by = film.solved, np.diag(_held(film, force)), holding(film, force)
    storage = (rate, rate * held(solved, instant)) if rate else (0.0, 0.0)
    drive = Drive(
        speed=solved.problem.speed,
        force=force + held_by @ instant.place,
        stiffness=held_by + aligned_by,
        free=film.free,
        storage=storage,
    )
    return settled(solved, instant, drive, tolerance=tolerance, starved=True)


def _move(film: FreeFilm, instant: Instant, following: Instant) -> float:
    """The largest move of a coordinate over its unit and its size; 0 of a pad about its pivot, which may move more."""
    if not isinstance(film.scene.geometry, Shaft):
        return 0.0
    sizes = film.wall.unit + np.abs(instant.place)
    return float((np.abs(following.place - instant.place) / sizes).max())


def _leaves(force: Array) -> InputError:
    toward = np.degrees(np.arctan2(force[1], force[0]))
    return InputError(
        f"load: got {np.hypot(*force[:2]):.6g} N towards {toward:.4g} degrees from the x axis; no film resists it, and "
        "the shaft leaves its bore; turn the load or the bore, or take a longer arc"
    )


def _rate(film: FreeFilm) -> float:
    """The rate at which the shaft turns, rad/s, or at which the load would close the clearance at rest."""
    scene, length = film.scene, film.scene.geometry.length
    if scene.motion.speed:
        return abs(scene.motion.speed) / length * 2 * np.pi
    squeezed = (scene.load_pressure or 0.0) / scene.lubricant.viscosity * (float(film.wall.unit[0]) / length) ** 2
    return max(squeezed, 1e-6)


def holding(film: FreeFilm, force: Array) -> Array:
    """The stiffness that aligns pads with the shaft, shape (coordinates, coordinates); 0 without tilting pads.

    A pad without pressure has no moment at any tilt. With the angle θ_p of its pivot and the place e of the shaft, its
    film is symmetric about the pivot but for the term -(e_t + R δ) sin(θ - θ_p) with e_t = e_y cos θ_p - e_x sin θ_p.
    The stiffness opposes e_t + R δ by a moment on the pad, and by no force on the shaft, so that a pad that carries no
    load rests at the tilt nearest to alignment at which its film carries nothing. It changes moments of pads that carry
    load by about ``ALIGNING``, of pads far from a heavily loaded shaft too.
    """
    geometry, unit = film.scene.geometry, film.wall.unit
    stiffness = np.zeros((unit.size, unit.size))
    if isinstance(geometry, Lobes):
        for pad, angle in enumerate(geometry.pivots):
            tangent = np.zeros(unit.size)
            tangent[:2], tangent[2 + pad] = (-np.sin(angle), np.cos(angle)), geometry.radius
            stiffness[2 + pad] = geometry.radius * tangent
    return np.asarray(ALIGNING * (_sliding_scale(film) or _load_scale(film, force)) / unit[0] * stiffness)


def _held(film: FreeFilm, force: Array) -> Array:
    """The stiffness of each coordinate against moves in a step, which has no force in equilibrium; 0 without pads.

    A shaft on a single pad that tilts has no force across it.
    """
    unit, geometry = film.wall.unit, film.scene.geometry
    if not isinstance(geometry, Lobes) or geometry.pivot is None:
        return np.zeros(unit.size)
    return np.where(film.wall.turns, 0.0, HOLDING * _load_scale(film, force) / unit)


def _load_scale(film: FreeFilm, force: Array) -> float:
    """The load of a shaft, or η u B (R/c)² if that is larger, N."""
    return max(float(np.abs(force).max()), _sliding_scale(film)) if isinstance(film.scene.geometry, Shaft) else 0.0


def _sliding_scale(film: FreeFilm) -> float:
    """η u B (R/c)² of a shaft, N; 0 of other bearings."""
    scene, geometry = film.scene, film.scene.geometry
    if not isinstance(geometry, Shaft):
        return 0.0
    width = 1.0 if film.whole.problem.shape.wide else geometry.width or 1.0
    across = float(geometry.radius / film.wall.unit[0])
    return scene.lubricant.viscosity * abs(scene.motion.speed) * width * across**2


def refined(coarse: FreeFilm, instant: Instant, fine: FreeFilm) -> Instant:
    """An instant on a finer grid, from which its equilibrium there is sought."""
    one, other = coarse.solved, fine.solved
    state = carried(instant.state, one.grid, other.grid, other.problem.shape.joined)
    first = fine.first(instant.place)
    return replace(first, state=state, kind=kinds(first.network, state), pressures=instant.pressures)
