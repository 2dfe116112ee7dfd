"""The walls of a march: smooth, with averaged roughness, or with asperities that touch."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.rom.bearing.equilibrium.expected import MIN_FILM_OVER_PEAK
from roughfilm.rom.bearing.film import FlooredFlowFactors
from roughfilm.rom.bearing.free.lay import oblique
from roughfilm.rom.bearing.mixed.asperities import SpotPressures
from roughfilm.rom.bearing.mixed.asperity_table import HERTZ_POWER, AsperityTable
from roughfilm.rom.bearing.mixed.film import mixed_problem
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.roughness import RoughSurface, Sinusoid
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap


@dataclass(frozen=True, kw_only=True)
class Walls:
    """The film between the walls of a bearing, and their contact.

    Attributes
    ----------
    film : film(scene), the problem of a film.
    contact : flow factors and contact pressures of the asperities; None of walls that do not touch.
    closest : smallest film thickness of which the flow factors are known, m; 0 of smooth walls.
    factors : the flow factors over the film thickness; None of smooth walls.
    of_factors : of_factors(film), the relative uncertainty of the flow factors at a film thickness of at least this, m.
    """

    film: Callable[[Bearing], Problem] = Bearing.problem
    contact: AsperityTable | None = None
    closest: float = 0.0
    factors: FactorsOverGap | None = None
    of_factors: Callable[[float], float] = lambda _film: 0.0

    def of_lay(self, film: float, *, even: bool) -> float:
        """The relative error by the cross flow of the lay that is left out, at a film thickness.

        Its sign does not matter to a film that is symmetric about the middle of its width, which has its square.
        """
        if self.factors is None:
            return 0.0
        return float(oblique(self.factors(np.array([film])))[0]) ** (2 if even else 1)

    def spots(self, film: float) -> SpotPressures | None:
        """The pressures on the spots in contact at a film thickness, m; None of walls that do not touch."""
        return None if self.contact is None else self.contact.spot_pressures(max(film, self.contact.closest))

    def of_contact(self, film: float) -> tuple[float, float]:
        """The uncertainty of contact pressures at a film thickness: relative, and that of the film, m, which follows.

        With p_c ~ (α₀ - α)^1.5 near first contact at α₀, δα = δp/p (α₀ - α)/1.5.
        """
        if self.contact is None or film >= self.contact.touching:
            return 0.0, 0.0
        relative = float(self.contact.pressure_uncertainty(np.array([film]))[0])
        return relative, min(relative / HERTZ_POWER, 1.0) * (self.contact.touching - film)


def walls_of(scene: Bearing) -> Walls:
    """The walls of a scene; flow factors of a surface are known down to a mean gap of its rms height.

    Raises
    ------
    InputError
        If a table cannot be read, or has no contact pressures.
    ConvergenceError
        If flow factors or contacts do not converge.
    """
    roughness = scene.roughness
    if scene.asperities is not None:
        tips = asperities_of(scene)
        return Walls(
            film=lambda one: mixed_problem(one, tips),
            contact=tips,
            factors=tips,
            of_factors=tips.factor_uncertainty,
        )
    if roughness is None:
        return Walls()
    factors: FactorsOverGap
    if isinstance(roughness, Sinusoid):
        closest = MIN_FILM_OVER_PEAK * roughness.peak
        factors = roughness.factors(closest)
    else:
        factors = table = roughness.factors(roughness.rms)
        closest = max(roughness.rms, table.narrowest)
    floored = FlooredFlowFactors(factors)

    def film(one: Bearing) -> Problem:
        problem = one.problem()
        return replace(problem, shape=replace(problem.shape, roughness=floored))

    return Walls(
        film=film,
        closest=closest,
        factors=floored,
        of_factors=lambda least: roughness.factor_uncertainty(
            max(least, closest) if isinstance(roughness, RoughSurface) else least
        ),
    )
