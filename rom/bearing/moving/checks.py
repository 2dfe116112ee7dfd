"""The checks of a scene that moves: which columns and bodies fit which walls."""

import numpy as np

from roughfilm.rom.bearing.geometry.journal import Journal, Shaft
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.open_bore import OpenBore
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.geometry.shapes import AnyShape
from roughfilm.rom.bearing.moving.body import Body, Start
from roughfilm.rom.bearing.moving.over_time import OverTime

OF_SHAFTS = frozenset({"angle", "load_x", "load_y", "eccentricity_x", "eccentricity_y"})
"""Columns that only a shaft has."""

MOMENTS = frozenset({"moment_x", "moment_y"})
"""Columns that only a pad about a pivot has."""


def check_motion(geometry: AnyShape, over_time: OverTime | None, body: Body | None, *, loaded: bool) -> None:
    """Raise ValueError, in one line, for columns or a body that the wall cannot have.

    Parameters
    ----------
    loaded : whether the scene has a load.
    """
    if over_time is None and body is None:
        return
    if isinstance(geometry, Journal):
        geometry = OpenBore.of(geometry)
    lobes, columns = isinstance(geometry, Lobes), over_time.table.columns.keys() if over_time is not None else set()
    wrong = sorted({"film"} & columns if lobes else OF_SHAFTS & columns)
    if wrong:
        remedy = "eccentricity_x and eccentricity_y" if lobes else "load or film"
        wall = "a shaft" if lobes else f"shape = {geometry.shape!r}"
        raise ValueError(f"motion.over_time.{wrong[0]}: got it for {wall}; give {remedy}")
    for moment in sorted(MOMENTS & columns):
        _check_moment(geometry, moment)
    turns = isinstance(geometry, Shaft | Ring)
    if over_time is not None and over_time.table.units.get("speed") == "rad/s" and not turns:
        raise ValueError(
            f"motion.over_time.speed: got a rotational one, but shape = {geometry.shape!r} slides; give m/s"
        )
    if (
        over_time is not None
        and geometry.width is None
        and "N" in {over_time.table.units.get(n) for n in ("load", "load_x")}
    ):
        raise ValueError(
            "motion.over_time.load: got a force for an infinitely wide bearing; give N/m in a file, or a width"
        )
    given = {"film", "eccentricity_x"} & columns
    if given and loaded:
        raise ValueError(f"motion.over_time.{min(given)}: got a path beside [load]; give one of the two")
    if isinstance(geometry, Lobes) and over_time is not None and "eccentricity_x" in columns:
        _check_path(geometry, over_time)
    if body is not None:
        _check_body(geometry, body, free=not given and (loaded or bool({"load", "load_x"} & columns)))


def _check_moment(geometry: AnyShape, moment: str) -> None:
    place = f"motion.over_time.{moment}"
    if not isinstance(geometry, Tilting) or geometry.width is None:
        wide = "infinitely wide " if geometry.width is None else ""
        raise ValueError(
            f"{place}: got it for the {wide}shape {geometry.shape!r}; pivoted pads with a width have moments"
        )
    if geometry.slopes is not None:
        raise ValueError(f"{place}: got it beside geometry.slopes, which no moment changes; leave one of them out")
    if moment == "moment_x" and not geometry.tilts_across:
        raise ValueError(f"{place}: got it for a pivot with line = true, which takes it; leave it out")


def _check_path(geometry: Lobes, over_time: OverTime) -> None:
    columns = over_time.table.columns
    least = geometry.least_films(np.array([columns["eccentricity_x"], columns["eccentricity_y"]]))
    row = int(np.argmin(least))
    if least[row] <= 0:
        place = [float(columns[name][row]) for name in ("eccentricity_x", "eccentricity_y")]
        raise ValueError(
            f"motion.over_time.eccentricity_x: got {place} in row {row + 1}; the shaft reaches {-least[row]:.3g} m "
            "into the bore; lower it"
        )


def _check_body(geometry: AnyShape, body: Body, *, free: bool) -> None:
    lobes = isinstance(geometry, Lobes)
    if not free and (body.mass is not None or body.unbalance is not None):
        raise ValueError("body: got one that no load acts on; give [load], or loads over time")
    if body.unbalance is not None and not lobes:
        raise ValueError(f"body.unbalance: got one for shape = {geometry.shape!r}; only a shaft has one")
    if body.inertia is not None and (not isinstance(geometry, Tilting) or geometry.slopes is not None):
        kind = "given slopes" if isinstance(geometry, Tilting) else f"shape = {geometry.shape!r}"
        raise ValueError(f"body.inertia: got one for {kind}; only a pad that tilts about a pivot has one")
    start = body.start
    if start is None:
        return
    if start.slopes is not None:
        _check_slopes(geometry, start)
    if (lobes and start.film is not None) or (not lobes and start.eccentricity is not None):
        wrong, right = ("film", "eccentricity") if lobes else ("eccentricity", "film")
        wall = "a shaft" if lobes else f"shape = {geometry.shape!r}"
        raise ValueError(f"body.start.{wrong}: got it for {wall}; give {right}")
    if start.velocity is not None and len(start.velocity) != (2 if lobes else 1):
        raise ValueError(
            f"body.start.velocity: got {len(start.velocity)} entries; give {'two, along x and y' if lobes else 'one'}"
        )
    if isinstance(geometry, Lobes) and start.eccentricity is not None:
        placed = geometry.model_copy(update={"eccentricity": start.eccentricity})
        if placed.least_film <= 0:
            raise ValueError(
                f"body.start.eccentricity: got {list(start.eccentricity)}; the shaft reaches {-placed.least_film:.3g} "
                "m into the bore; lower it"
            )


def _check_slopes(geometry: AnyShape, start: Start) -> None:
    assert start.slopes is not None
    if not isinstance(geometry, Tilting) or geometry.slopes is not None:
        kind = "given slopes" if isinstance(geometry, Tilting) else f"shape = {geometry.shape!r}"
        raise ValueError(f"body.start.slopes: got them for {kind}; only a pad that tilts about a pivot has them")
    if start.film is None:
        raise ValueError("body.start.film: is missing beside slopes; give both")
    if start.slopes[1] != 0 and not geometry.tilts_across:
        raise ValueError(
            f"body.start.slopes: got {start.slopes[1]!r} rad across the sliding for a pad that tilts along it alone; "
            "take 0"
        )
