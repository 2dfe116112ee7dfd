"""The search for the film under a load at each speed of a curve, where it is one over the separation of the walls."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import exp
from typing import Protocol, Self

import numpy as np
import scipy

from roughfilm.rom.bearing.equilibrium.balance import STEEPNESS, FilmsAtSpeed, balanced, robustly_balanced
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.film import MixedFilm, MixedState
from roughfilm.rom.bearing.mixed.search.lift_off import lift_off_speed
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.network import State

EXTRAPOLATION_POINTS = 4
"""Number of points from which the next separation is extrapolated."""

MAX_LOG_STEP = 0.4
"""Largest change of the logarithm of the separation by extrapolation."""

SEPARATION_STEP = 1e-3
"""Step over which the slope of the contact load is taken, over the separation of first contact."""

Known = Sequence[tuple[float, float]]
"""Speeds, m/s, and separations, m, of points under the same load."""


@dataclass(frozen=True, kw_only=True)
class Slopes:
    """The increase of the loads of film and asperities as the walls approach, N/m, and the length of the power law, m.

    The load of the film changes by about itself over that length. ``left_out`` is the relative error of that load by a
    cross flow of the roughness that is left out.
    """

    film: float
    contact: float
    length: float
    left_out: float = 0.0


class Search(Protocol):
    """The films of a bearing on one grid at any speed and load."""

    @property
    def scene(self) -> Bearing:
        """The bearing."""
        ...

    @property
    def asperities(self) -> Asperities:
        """Flow factors and contact pressures."""
        ...

    @property
    def dip(self) -> float:
        """The least film thickness of the geometry minus the separation at the narrowest place, m."""
        ...

    @property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        ...

    def solved(self, speed: float, pressure: float, known: Known) -> MixedState:
        """The film at a speed, m/s, under a load over the nominal area, Pa; InputError if none carries it."""
        ...

    def again(self, speed: float, pressure: float, separation: float) -> MixedState:
        """The film of a point that was solved before."""
        ...

    def slopes(self, speed: float, pressure: float, separation: float, film_load: float) -> Slopes:
        """The slopes of the loads at a point."""
        ...

    def lift_off(self, pressure: float, near: float) -> float:
        """The lift-off speed, m/s, from a guess, as of :mod:`roughfilm.rom.bearing.mixed.search.lift_off`."""
        ...

    def coarser(self) -> Self:
        """The films on a grid of half as many cells."""
        ...

    def of(self, scene: Bearing) -> Self:
        """The films of a scene with another lubricant, whose search starts from those that were solved before."""
        ...

    def anew(self) -> Self:
        """The films of which none was solved before."""
        ...


@dataclass(kw_only=True)
class SeparationSearch:
    """The search over the separation of walls that approach each other along one line.

    Attributes
    ----------
    film : the films at any separation and speed.
    """

    film: MixedFilm
    _at: FilmsAtSpeed[MixedState] | None = None
    _states: dict[float, State] = field(default_factory=dict)

    @property
    def scene(self) -> Bearing:
        """The bearing."""
        return self.film.scene

    @property
    def asperities(self) -> Asperities:
        """Flow factors and contact pressures."""
        return self.film.asperities

    @property
    def dip(self) -> float:
        """The film thickness of the geometry minus its minimum on the grid, m."""
        return self.film.dip

    @property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        return self.film.area

    def _films(self, speed: float) -> FilmsAtSpeed[MixedState]:
        """The films that were solved at a speed; those of the speed before are dropped."""
        if self._at is None or self._at.speed != speed:
            self._at = FilmsAtSpeed(film=self.film, speed=speed)
        return self._at

    def solved(self, speed: float, pressure: float, known: Known) -> MixedState:
        """The film at a speed under a load, from the films that were solved before."""
        at, start = self._films(speed), self._states.get(pressure)
        guess = self._extrapolated(known, at)
        if not known:
            at.steepness = STEEPNESS
        parts = self.scene.asperities is None
        search = robustly_balanced if parts and start is None and guess is None else balanced
        state = search(at, pressure, tolerance=self.film.accuracy, guess=guess, start=start)
        self._states[pressure] = state.solution.state
        return state

    def again(self, speed: float, _pressure: float, separation: float) -> MixedState:
        """The film at the separation of a point."""
        return self.film.at(separation + self.dip, speed)

    def _extrapolated(self, known: Known, at: FilmsAtSpeed[MixedState]) -> float | None:
        """The film thickness, m, extrapolated from the last points over the logarithm of the speed."""
        if not known:
            return None
        last = at.distance(known[-1][1] + self.dip)
        before = [point for point in known if point[0] > 0][-EXTRAPOLATION_POINTS:]
        if len(before) < 2:
            return known[-1][1] + self.dip
        speeds = np.log([speed for speed, _ in before])
        distances = [at.distance(separation + self.dip) for _, separation in before]
        following = float(scipy.interpolate.BarycentricInterpolator(speeds, distances)(np.log(at.speed)))
        return at.separation(min(max(following, last - MAX_LOG_STEP), last + MAX_LOG_STEP))

    def slopes(self, speed: float, _pressure: float, separation: float, film_load: float) -> Slopes:
        """The slopes by the power law of the film and by the contact load at another separation."""
        at, place, step = self._films(speed), separation + self.dip, SEPARATION_STEP * self.film.touching
        length = exp(at.distance(place))
        nearer = self.film.contact_load(max(place - step, self.film.closest))
        return Slopes(
            film=at.steepness * abs(film_load) / length,
            contact=(nearer - self.film.contact_load(place)) / step,
            length=length,
        )

    def lift_off(self, pressure: float, near: float) -> float:
        """The speed at which the film alone carries the load at first contact, m/s."""
        separation, state = self.film.touching, None
        if separation >= self.film.widest:
            return float("nan")

        def excess(speed: float) -> float:
            nonlocal state
            solved = self.film.at(separation, speed, state)
            state = solved.solution.state
            return solved.load / (pressure * self.film.area) - 1

        return lift_off_speed(excess, near, tolerance=self.film.accuracy)

    def coarser(self) -> Self:
        """The films on a grid of half as many cells."""
        return type(self)(film=replace(self.film, cells=self.film.cells // 2))

    def of(self, scene: Bearing) -> Self:
        """The films of a scene with another lubricant, whose search starts from those that were solved before."""
        return type(self)(film=replace(self.film, scene=scene), _states=self._states)

    def anew(self) -> Self:
        """The films of which none was solved before."""
        return type(self)(film=self.film)
