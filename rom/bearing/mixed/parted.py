"""Films of walls that never touch, smooth or averaged over their roughness, for curves over speed."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.equilibrium.expected import closest_film, first_film
from roughfilm.rom.bearing.film import averaged_films
from roughfilm.rom.bearing.mixed.asperities import SpotPressures
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.bearing.scene import Bearing, BearingLoad
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.homogenization.gap_factors import GapFactors


@dataclass(frozen=True, kw_only=True)
class Parted:
    """Walls that never touch, as asperities without contact pressure.

    Attributes
    ----------
    closest : the smallest known separation, m.
    uncertainty : the relative uncertainty of the flow factors.
    """

    closest: float
    uncertainty: float = 0.0

    @property
    def touching(self) -> float:
        """The smallest known separation, m."""
        return self.closest

    @property
    def largest_pressure(self) -> float:
        """0, the contact pressure of walls that do not touch, Pa."""
        return 0.0

    def __call__(self, separation: Array, /) -> GapFactors:
        """The flow factors of smooth walls, each of the shape of ``separation``."""
        zero, inverse = np.zeros_like(separation), 1 / separation
        return GapFactors(
            along=separation**3,
            across=separation**3,
            cross=zero,
            drag=separation,
            drag_across=zero,
            couette=inverse,
            shear_couette=zero,
            streaming=inverse,
            least=separation,
        )

    def contact_pressure(self, separation: Array) -> Array:
        """0, Pa."""
        return np.zeros_like(separation)

    def mean_gap(self, separation: Array) -> Array:
        """The mean gap, m, which equals the separation."""
        return separation

    def area_fraction(self, separation: Array) -> Array:
        """0, the fraction of the nominal area in contact."""
        return np.zeros_like(separation)

    def spot_pressures(self, _separation: float) -> SpotPressures:
        """0, the pressures on spots in contact, Pa."""
        return SpotPressures(mean=0.0, peak=0.0, composite_modulus=math.inf)

    def factor_uncertainty(self, _separation: float) -> float:
        """The relative uncertainty of the flow factors."""
        return self.uncertainty

    def friction_uncertainty(self, _separation: float) -> float:
        """The relative uncertainty of the friction factor."""
        return self.uncertainty

    def pressure_uncertainty(self, separation: Array) -> Array:
        """0, the relative uncertainty of the contact pressure."""
        return np.zeros_like(separation)

    def separation_at(self, _pressure: float) -> float:
        """The smallest known separation, m."""
        return self.closest


def parted_film(
    scene: Bearing, speeds: Sequence[float], pressures: Sequence[float], resolution: int, tolerance: float
) -> MixedFilm:
    """The films of a scene without asperities, down to the thinnest that the loads may need.

    Parameters
    ----------
    speeds : sliding speeds, m/s, above 0.
    pressures : loads over the nominal area, Pa.
    resolution : number of cells along and across.
    tolerance : relative error of the load.

    Raises
    ------
    InputError
        If no film carries the largest load at the lowest speed, so that flow factors cannot be made for it.
    """
    heaviest = scene.model_copy(update={"load": BearingLoad.model_construct(pressure=max(pressures))})
    heaviest = heaviest.at_speed(min(speeds))
    if scene.roughness is None:
        closest = closest_film(heaviest) - scene.geometry.dip
        first = first_film(heaviest, closest + scene.geometry.dip)
        walls = Parted(closest=closest)
        film: Callable[[Bearing], Problem] = Bearing.problem
    else:
        among = averaged_films(heaviest)
        closest, first, film = among.closest - scene.geometry.dip, among.first, among.film
        relative = scene.roughness.factor_uncertainty(among.known_from or closest)
        walls = Parted(closest=closest, uncertainty=relative)
    return MixedFilm(scene=scene, asperities=walls, cells=resolution, accuracy=tolerance, film=film, first=first)
