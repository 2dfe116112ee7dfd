"""Films that become too thin on the way to an equilibrium, and why."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.free.idle import idle_pads
from roughfilm.rom.bearing.free.unbalanced import remedy
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.quantities import scene_positions
from roughfilm.rom.cavitation.motion.contact import ContactLaw
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, settled

CLOSEST = 1e-4
"""Least film over the clearance below which no equilibrium is sought."""

CLOSEST_CONTACT = 2e-3
"""Distance from the smallest known separation of walls that touch, over that of first contact from it."""

CLOSEST_ROUGH = 1e-2
"""Distance from the smallest film of which flow factors are known, over that film, below which none is sought."""

CLOSEST_PAD = 1e-2
"""The same for pads that carry no load, and over the film of a pad about its pivot that narrows to half."""

END = 0.25
"""Fraction of the length of a pad that counts as its inlet."""

ROUGHLY = 1e-6
"""Residual of a film of which only the sign of its force counts."""

EVEN = 0.5
"""Least over largest film from which on a film counts as even."""


def closed(film: FreeFilm, instant: Instant, force: Array) -> InputError | None:
    """The reason why there is no equilibrium, if a film has become too thin; else None."""
    contact = film.solved.contact
    if contact is not None:
        return _beyond_contact(film, instant, force, contact)
    known = film.solved.closest
    if known > 0 and film.solved.room(instant.place) < CLOSEST_ROUGH * known:
        return InputError(
            f"load: got {_loaded(film, force)}; no film above {known:.4g} m, the thinnest of which flow factors "
            "are known, carries it; lower the load, raise the speed or the viscosity, or add [asperities]"
        )
    thickness, geometry, x = instant.faces.thickness, film.scene.geometry, film.solved.grid.x
    least = float(thickness.min())
    pads = isinstance(geometry, Lobes) and geometry.pivot is not None
    limit = CLOSEST_PAD if pads or isinstance(geometry, Tilting) else CLOSEST
    if least >= limit * film.wall.unit[0]:
        return None
    i = int(np.argmin(thickness.min(axis=1)))
    if isinstance(geometry, Tilting):
        along = float((x[i] - x[0]) / (x[-1] - x[0]))
        middle = float(thickness[i, thickness.shape[1] // 2])
        if least > EVEN * float(thickness.max()) or along < END:
            place, remedy = "its inlet", "move the pivot towards the outlet; a flat pad needs one behind its middle"
        elif least > EVEN * middle:
            place, remedy = "its outlet", "move the pivot towards the middle, or take more cells"
        else:
            place, remedy = "a side", "move the pivot towards the middle of the width"
        given, load = f"geometry.pivot: got {list(geometry.pivot)}", film.scene.load
        if load is not None and (load.moment_x or load.moment_y):
            given += f" and moments of {load.moment_x:.4g} and {load.moment_y:.4g} N*m about x and y"
            remedy = f"change load.moment_x or load.moment_y, or {remedy}"
        return InputError(f"{given}; no tilt balances the moments, the film closes at {place}; {remedy}")
    if isinstance(geometry, Lobes) and geometry.pivot is not None:
        pad = int(geometry.lobe(scene_positions(film.solution(instant))[i]))
        if pad in idle_pads(film, instant):
            return InputError(
                f"geometry: pad {pad + 1} carries no load, and at every tilt the suction of its film draws an edge of "
                "it onto the shaft; raise the preload, move the pivot behind the middle, or set "
                "lubricant.cavitation_pressure to 0 Pa, at which air enters"
            )
    if least >= CLOSEST * film.wall.unit[0]:
        return None
    if not isinstance(geometry, Shaft) and _pushes(film, instant) <= 0:
        return InputError(
            f"load: got {_loaded(film, force)}; no film carries a load at this speed, as the walls are parallel or "
            "widen along the sliding; give the wall a rise or pockets, or reverse the speed"
        )
    remedies = ["lower the load", "raise the speed or the viscosity"]
    if isinstance(geometry, Lobes) and any(geometry.misalignment):
        remedies.insert(1, "lower geometry.misalignment")
    if film.scene.roughness is not None:
        remedies.append("give [asperities], which may touch")
    return InputError(
        f"load: got {_loaded(film, force)}; no film above {least:.2g} m carries it; "
        f"{', '.join(remedies[:-1])}, or {remedies[-1]}"
    )


def touching(film: FreeFilm, instant: Instant) -> ConvergenceError | None:
    """The reason why a film has no walls apart, which are so at the nodes of its grid; else None.

    Arcs are curved between the nodes, and at the end of a pad the film of a node is the mean of the pad and the gap.
    """
    geometry = film.scene.geometry
    if not isinstance(geometry, Lobes) or film.solved.contact is not None:
        return None
    least = geometry.at(instant.place).least_film
    if least > 0:
        return None
    return ConvergenceError(
        f"load: the walls touch between the nodes of the grid, where the film is {least:.3g} m thick; "
        f"{remedy(film.scene)}",
        outcome=Outcome.STALLED,
        iterations=instant.iterations,
    )


def starved(film: FreeFilm, instant: Instant) -> InputError | None:
    """The reason why a film has no equilibrium whose pressures behind all restrictors are above cavitation; or None.

    On the way to an equilibrium these pressures may fall below it, where they have no meaning.
    """
    restricted = film.solved.restricted
    if not film.solved.ruptures or not restricted:
        return None
    lowest = min(restricted, key=lambda number: float(instant.pressures[number]))
    pressure = float(instant.pressures[lowest])
    if pressure >= 0:
        return None
    supply = lowest - (len(film.solved.inflows) - len(film.scene.supply))
    given = film.scene.supply[supply].flow is not None
    passes = "is given" if given else "its restrictor passes"
    remedy = "raise the flow" if given else "raise the pressure, widen the restrictor"
    x, y = (float(value) for value in instant.place[:2] / film.wall.unit[0])
    at = f" at the eccentricity ({x:.3g}, {y:.3g})" if isinstance(film.scene.geometry, Shaft) else ""
    return InputError(
        f"supply.{supply}: in equilibrium{at} the film takes in more than {passes}, and the pressure would fall "
        f"{-pressure:.3g} Pa below that of cavitation; {remedy}, move the supply, or change the load"
    )


def _beyond_contact(film: FreeFilm, instant: Instant, force: Array, contact: ContactLaw) -> InputError | None:
    """The reason why there is no equilibrium if the walls come nearly as close as their contact is known for."""
    if film.solved.room(instant.place) >= CLOSEST_CONTACT * (contact.touching - contact.closest):
        return None
    pressed = film.solved.contact_at(instant.place).force
    return InputError(
        f"load: got {_loaded(film, force)}; at a separation of {contact.closest:.4g} m, the smallest whose contact "
        f"pressure is known, the asperities carry {_loaded(film, pressed)} and the film too little; lower the load, or "
        "make a table with larger loads"
    )


def _pushes(film: FreeFilm, instant: Instant) -> float:
    """The force by which the film of a pad at rest at its place pushes it off, N; infinite if none is found."""
    solved, count = film.solved, instant.place.size
    given = Drive(
        speed=solved.problem.speed,
        force=np.zeros(count),
        stiffness=np.zeros((count, count)),
        free=np.zeros(count, dtype=bool),
    )
    try:
        return float(solved.force(settled(solved, instant, given, tolerance=ROUGHLY).state.pressure)[0])
    except (ConvergenceError, FloatingPointError):
        return math.inf


def _loaded(film: FreeFilm, force: Array) -> str:
    """The size of a force on the wall without its moments, on all pads that are alike, per width of a wide film."""
    scene = film.scene
    size = float(np.hypot(*force[:2])) if isinstance(scene.geometry, Shaft) else abs(float(force[0]))
    return f"{size * (scene.pieces or 1):.6g} {'N/m' if scene.wide else 'N'}"
