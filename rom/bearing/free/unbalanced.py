"""Why no place of a wall balances its load, as far as the scene shows it."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.scene import Bearing


def unbalanced(film: FreeFilm, force: Array) -> InputError | None:
    """The reason why no film balances a load with its moments, if the scene shows it; else None.

    Pressures are at least the cavitation pressure p_c, so that the centre of p - p_c lies inside of the pad. With the
    load W, the area A with its centre ξ_A from the pivot, and the moment M of the film about the pivot, it lies at
    ξ = (M - p_c A ξ_A)/(W - p_c A).

    Parameters
    ----------
    force : the load on each coordinate, N (N m of a slope; per width if infinitely wide).
    """
    geometry = film.scene.geometry
    walls_touch = film.solved.contact is not None
    loaded = bool(film.free[0])  # at a given film its load is whatever balances the moments
    if not isinstance(geometry, Tilting) or geometry.tilted or walls_touch or not (film.solved.ruptures and loaded):
        return None
    grid, lowest = film.whole.grid, film.scene.lubricant.cavitation_pressure
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    load = -force[0] - lowest * float(grid.areas.sum())
    if load <= 0:
        return None
    for normal, on_slope, key in zip(film.whole.normals[1:], -force[1:], ("moment_y", "moment_x"), strict=False):
        place = normal(x, y)
        first, last, at_rest = float(place.min()), float(place.max()), lowest * float((grid.areas * place).sum())
        centre = (on_slope - at_rest) / load
        if first < centre < last:
            continue
        along = key == "moment_y"
        sign = 1.0 if along else -1.0
        bounds = sorted(sign * (load * end + at_rest) for end in (first, last))
        given = sign * on_slope
        where = "along the sliding" if along else "across it"
        if given == 0:
            return InputError(
                f"geometry.pivot: got {list(geometry.pivot)}; it lies at an edge of the pad, and the centre of the "
                f"pressure must lie inside; move the pivot {where}"
            )
        return InputError(
            f"load.{key}: got {given:.6g} N*m, which puts the centre of the pressure {centre:.4g} m from the pivot "
            f"{where}, and the pad ends at {first:.4g} and {last:.4g} m; this load balances moments between "
            f"{bounds[0]:.4g} and {bounds[1]:.4g} N*m; lower the moment or raise the load"
        )
    return None


def remedy(scene: Bearing) -> str:
    """What to change where the motion of a wall towards its equilibrium does not settle, in words."""
    geometry = scene.geometry
    if isinstance(geometry, Tilting):
        if geometry.slopes is not None:
            return "give smaller geometry.slopes by which the film narrows, leave them out, or take more cells"
        if scene.load is not None and (scene.load.moment_x or scene.load.moment_y):
            return "lower load.moment_x and load.moment_y, take another pivot, or more cells"
        return "take more cells, or another pivot"
    if isinstance(geometry, Lobes):
        if geometry.tilts is not None:
            return "give smaller geometry.tilts, leave them out, or take more cells"
        if any(geometry.misalignment):
            return "lower geometry.misalignment, take more cells, or another load"
    return "take more cells, or another load"
