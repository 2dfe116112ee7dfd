"""Random fields with the power spectrum, the heights and the scatter of the windows of a measurement."""

import itertools
import math
from dataclasses import replace
from typing import Annotated

import numpy as np
import scipy
from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, Part, PositiveNumber, plain_number
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import whole_between
from roughfilm.contact.synthetic.distribution import with_heights_of
from roughfilm.contact.synthetic.grid import Grid, metres
from roughfilm.contact.synthetic.waves import MAX_SEED, Waves, random_waves

MIN_WINDOWS = 4.0
"""Smallest effective number of windows of a population."""

MAX_CHANGE = 8.0
"""Largest change of a logarithm from its mean; it bounds what few windows may extrapolate to."""

LEAST_ROOT = 0.01
"""Smallest square root of a step between heights, in units of the rms height."""

ITERATIONS = 20
"""Largest number of iterations that bring spectrum and heights together."""

DECIBEL = math.log(10) / 10
"""Natural logarithm of the ratio that is one decibel."""

Number = Annotated[float, BeforeValidator(plain_number)]
Numbers = Annotated[tuple[Number, ...], Field(min_length=1, max_length=2000)]
WaveNumbers = Annotated[
    tuple[Annotated[int, Field(strict=True, ge=0, le=100_000)], ...], Field(min_length=2, max_length=200)
]


class SpectrumTable(Part):
    """The mean power of single waves over their wave numbers, in decibels.

    Attributes
    ----------
    period : lengths of the period along x and y in which the wave numbers count waves, m.
    waves_x : wave numbers m >= 0 along x of the table, from 0, increasing.
    waves_y : wave numbers n >= 0 along y, from 0, increasing.
    decibels : one row for each n; each row has the powers at -m and m in increasing order, over any reference.
    """

    period: tuple[Length, Length]
    waves_x: WaveNumbers
    waves_y: WaveNumbers
    decibels: Annotated[tuple[Numbers, ...], Field(min_length=2, max_length=200)]

    @model_validator(mode="after")
    def _fitting(self) -> "SpectrumTable":
        for name, waves in (("waves_x", self.waves_x), ("waves_y", self.waves_y)):
            if waves[0] != 0 or any(b <= a for a, b in itertools.pairwise(waves)):
                raise ValueError(f"{name}: got {list(waves)[:6]} ...; write wave numbers that increase from 0")
        columns = 2 * len(self.waves_x) - 1
        if len(self.decibels) != len(self.waves_y) or any(len(row) != columns for row in self.decibels):
            raise ValueError(f"decibels: write {len(self.waves_y)} rows of {columns} numbers, one for each wave")
        return self


class Mode(Part):
    """One independent change between windows, of one standard deviation.

    Attributes
    ----------
    octaves : change of the power of each octave, decibels.
    steps : change of the square root of each step between heights.
    """

    octaves: Numbers
    steps: Numbers


class Population(Part):
    """How the windows of a surface differ.

    Attributes
    ----------
    windows : effective number of independent windows that it is estimated from, 4 or more.
    rms_height : rms height of the mean window, m.
    octaves : power of each octave of wave vectors, from the longest waves, decibels over any reference.
    scores : normal scores x at which heights are given, increasing; a height at x is exceeded by the fraction 1 - Φ(x).
    heights : heights at these scores over the rms height, increasing.
    modes : independent changes between windows; none where windows do not differ.
    """

    windows: PositiveNumber
    rms_height: Length
    octaves: Numbers
    scores: Annotated[tuple[Number, ...], Field(min_length=3, max_length=200)]
    heights: Annotated[tuple[Number, ...], Field(min_length=3, max_length=200)]
    modes: tuple[Mode, ...] = ()

    @model_validator(mode="after")
    def _fitting(self) -> "Population":
        if self.windows < MIN_WINDOWS:
            raise ValueError(f"windows: got {self.windows:g}; a scatter is known from {MIN_WINDOWS:g} windows and more")
        for name, values in (("scores", self.scores), ("heights", self.heights)):
            if any(b <= a for a, b in itertools.pairwise(values)):
                raise ValueError(f"{name}: must increase")
        if len(self.heights) != len(self.scores):
            raise ValueError(f"heights: got {len(self.heights)} for {len(self.scores)} scores; write one for each")
        for number, mode in enumerate(self.modes):
            if len(mode.octaves) != len(self.octaves) or len(mode.steps) != len(self.scores) - 1:
                raise ValueError(
                    f"modes {number + 1}: write {len(self.octaves)} octaves and {len(self.scores) - 1} steps"
                )
        return self


def random_field(
    *,
    size: tuple[float, float],
    points: tuple[int, int],
    seed: int,
    spectrum: SpectrumTable,
    population: Population,
) -> Surface:
    """A random surface that scatters from seed to seed as the windows of a surface do.

    A seed first draws v, the logarithms of the powers of all octaves and the square roots of the steps between heights
    at given quantiles: v = v̄ + sqrt(1 + 1/N) Σ gₖ mₖ / sqrt(χ²/(N - 1)), with the modes mₖ, normal gₖ and χ² of N - 1
    degrees of freedom, the distribution of a further window if N independent ones were drawn from a multivariate normal
    distribution. It then draws waves of random phase and Rayleigh amplitude whose mean power has the direction and
    wavelength of the table, scales each octave to its power, and brings the heights to their quantiles by the iteration
    of ``roughfilm.contact.synthetic.distribution.with_heights_of``.

    Parameters
    ----------
    size, points : period, m, and number of points, along x and y.
    seed : 0 to 2^63 - 1.
    spectrum : mean power of single waves. Between its wave numbers the decibels are interpolated; beyond them there is
        no power.
    population : powers of the octaves and distribution of heights, and how they differ between windows. Octave k has
        the waves whose wave number with respect to the shorter period is 2^k to 2^(k + 1); the first one also all
        longer waves, the last all shorter ones.

    Returns
    -------
    Surface : periodic, of mean 0; ``source["achieved"]`` holds rms height and rms slope before, and
        ``source["distribution"]`` the results of the iteration.

    Raises
    ------
    InputError
        If an argument is out of range, or the grid does not resolve the shortest wave of the table.

    Notes
    -----
    A size other than the period of the table has the same scatter, not that of windows of this size. Waves longer than
    the period carry no power of their own.

    Sources: the iteration, Schreiber and Schmitz, doi:10.1103/PhysRevLett.77.635; the predictive distribution,
    A. Gelman et al., Bayesian Data Analysis, section 3.6.
    """
    grid = Grid(kind="random_field", size=size, points=points)
    whole_between("random_field.seed", seed, 0, MAX_SEED)
    cut_off = max(spectrum.period[0] / spectrum.waves_x[-1], spectrum.period[1] / spectrum.waves_y[-1])
    grid.resolves("spectrum", cut_off)
    power, heights = drawn(population, np.random.default_rng((seed, 1)))
    waves = random_waves(
        grid,
        spectrum=lambda qx, qy: power_of_waves(spectrum, qx, qy),
        cut_off=cut_off,
        seed=(seed, 0),
        amplitudes="random",
        rms_height=population.rms_height,
    )
    waves = _scaled(waves, octave_of(waves.qx, waves.qy, spectrum.period, power.size), power)
    surface = grid.surface(
        waves.heights(points),
        {
            "seed": seed,
            "spectrum": spectrum.model_dump(mode="json"),
            "population": population.model_dump(mode="json"),
        },
        {"rms_height": metres(waves.rms_height), "rms_slope": waves.rms_slope, "waves": 2 * waves.m.size},
    )

    def quantile(probability: Array) -> Array:
        z = at_scores(np.array(population.scores), heights, scipy.special.ndtri(probability))
        z -= z.mean()
        return np.asarray(z * (waves.rms_height / z.std()))

    return with_heights_of(surface, quantile, iterations=ITERATIONS)


def drawn(population: Population, random: np.random.Generator) -> tuple[Array, Array]:
    """Powers of the octaves of one seed, m², and its heights at the scores, in any unit and of any mean."""
    octaves, steps = DECIBEL * np.array(population.octaves), np.sqrt(np.diff(population.heights))
    octaves = octaves - scipy.special.logsumexp(octaves) + 2 * math.log(population.rms_height)
    freedom = population.windows - 1
    factor = math.sqrt((1 + 1 / population.windows) * freedom / random.chisquare(freedom))
    change_of_octaves, change_of_steps = np.zeros(octaves.size), np.zeros(steps.size)
    for mode, weight in zip(population.modes, random.standard_normal(len(population.modes)), strict=True):
        change_of_octaves += factor * weight * DECIBEL * np.array(mode.octaves)
        change_of_steps += factor * weight * np.array(mode.steps)
    power = np.exp(octaves + np.clip(change_of_octaves, -MAX_CHANGE, MAX_CHANGE))
    growth = np.maximum(steps + change_of_steps, LEAST_ROOT) ** 2
    return np.asarray(power), np.concatenate([[0.0], np.cumsum(growth)])


def at_scores(scores: Array, heights: Array, x: Array) -> Array:
    """Heights at normal scores x by monotone cubics, beyond the outermost scores by the slopes of the last steps."""
    z = scipy.interpolate.PchipInterpolator(scores, heights)(np.clip(x, scores[0], scores[-1]))
    low, high = ((heights[i + 1] - heights[i]) / (scores[i + 1] - scores[i]) for i in (0, -2))
    z += low * np.minimum(x - scores[0], 0.0) + high * np.maximum(x - scores[-1], 0.0)
    return np.asarray(z)


def power_of_waves(spectrum: SpectrumTable, qx: Array, qy: Array) -> Array:
    """The mean power of single waves by the table, up to a constant factor, for wave vectors in rad/m; 0 beyond it."""
    m, n = (q * side / (2 * np.pi) for q, side in zip((qx, qy), spectrum.period, strict=True))
    m, n = np.where(n < 0, -m, m), np.abs(n)
    columns = np.concatenate([-np.array(spectrum.waves_x[:0:-1], dtype=float), spectrum.waves_x])
    table = scipy.interpolate.RegularGridInterpolator(
        (columns, np.array(spectrum.waves_y, dtype=float)),
        np.array(spectrum.decibels).T,
        bounds_error=False,
        fill_value=-np.inf,
    )
    return np.asarray(np.exp(DECIBEL * (table(np.stack([m, n], axis=-1)) - np.max(spectrum.decibels))))


def octave_of(qx: Array, qy: Array, period: tuple[float, float], count: int) -> Array:
    """The octave of each wave vector, 0 to count - 1; ``qx`` and ``qy``, rad/m, are broadcast."""
    number = np.hypot(qx, qy) * min(period) / (2 * np.pi)
    octave = np.floor(np.log2(np.maximum(number, 1.0)) + 1e-9).astype(int)
    return np.asarray(np.clip(octave, 0, count - 1))


def _scaled(waves: Waves, octaves: Array, power: Array) -> Waves:
    """The waves with the given power in each octave; an octave without waves has none."""
    own = np.bincount(octaves, 2 * np.abs(waves.amplitudes) ** 2, minlength=power.size)
    factors = np.sqrt(np.divide(power, own, out=np.zeros(power.size), where=own > 0))
    return replace(waves, amplitudes=waves.amplitudes * factors[octaves])
