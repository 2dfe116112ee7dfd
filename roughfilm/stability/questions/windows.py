"""Surfaces of known statistics, and windows of them, that test what is concluded from few windows."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.preparation.form import remove_form
from roughfilm.contact.preparation.prepare import cell_of, level
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.preparation.window import Window
from roughfilm.contact.surfaces.surface import Surface

SEED = 20071
"""Seed of the random surfaces."""

SIDES = (1, 2, 4, 8, 16, 30)
"""Sides of the windows over the correlation length, at which the autocorrelation is 0.2."""

BANK = 160
"""Number of windows of each side, far apart from each other, whose mean is the true one."""

LOAD = 0.08
"""Load P/(E* g') under which windows are pressed; about 15 % of them touch."""

MODULUS = 1e11
"""Composite modulus E*, Pa."""

SEPARATION = 1.5
"""Height of the smooth wall above the mean plane over Sq, for the mean cube of the gap."""

PRESSED = ("Sq", "rms slope", "contact area", "permeability")
"""Quantities of a window that is joined, pressed, and permeated by a film."""

GEOMETRIC = ("Sq", "rms slope", "gap cubed")
"""Quantities of a window as it is cut; the cube of the gap is that of nodes below the smooth wall."""

MIN_PIXELS = 2.0
"""Smallest correlation length, pixels."""

JOINT_OF_SIDE = 1 / 40
"""Width over which windows are joined, over their side."""

SCRATCH_DEPTH = 5.0
"""Depth of a scratch over Sq."""

RATES = (0.03, 0.1, 0.3, 1.0, 3.0)
"""Mean numbers of scratches in a window."""

RARE_BANK = 1000
"""Number of windows with scratches."""


@dataclass(frozen=True, kw_only=True)
class RandomSurface:
    """An endless Gaussian surface of rms height 1, drawn on a periodic grid much larger than what is cut of it.

    Attributes
    ----------
    name : name of the surface.
    power : power spectrum, up to a factor, of the wave numbers in x and y, cycles a pixel.
    period : number of pixels along a side of the grid.
    """

    name: str
    power: Callable[[Array, Array], Array]
    period: int

    def amplitudes(self) -> Array:
        """The amplitudes of the waves for a variance of 1, as ``numpy.fft.rfft2`` orders them."""
        power = self.power(*_wave_numbers(self.period))
        power[0, 0] = 0.0
        return np.asarray(np.sqrt(power / np.fft.irfft2(power, s=(self.period, self.period))[0, 0]))

    def draw(self, rng: np.random.Generator, amplitudes: Array) -> Array:
        """Heights of rms 1 in the mean over many draws, shape (period, period)."""
        noise = np.fft.rfft2(rng.standard_normal((self.period, self.period)))
        return np.asarray(np.fft.irfft2(noise * amplitudes, s=(self.period, self.period)))

    def slope(self) -> float:
        """The rms slope by differences of neighbours, √(4 − 2 R(1, 0) − 2 R(0, 1))."""
        r = np.fft.irfft2(self.amplitudes() ** 2, s=(self.period, self.period))
        return math.sqrt(4 - 2 * float(r[1, 0]) - 2 * float(r[0, 1]))

    def truth(self) -> Array:
        """The values of ``GEOMETRIC`` on the whole surface, from its spectrum and the normal distribution."""
        return np.array([1.0, self.slope(), _gap_cubed(SEPARATION)])


def _wave_numbers(period: int) -> tuple[Array, Array]:
    """The wave numbers in x and y, cycles a pixel, of ``numpy.fft.rfft2``."""
    return np.asarray(np.fft.fftfreq(period)[:, None], float), np.asarray(np.fft.rfftfreq(period)[None], float)


def _gap_cubed(s: float) -> float:
    """The mean of (s − z)³ over z < s of the normal distribution, (s³ + 3 s) Φ(s) + (s² + 2) φ(s)."""
    below = 0.5 * math.erfc(-s / math.sqrt(2))
    density = math.exp(-(s**2) / 2) / math.sqrt(2 * math.pi)
    return (s**3 + 3 * s) * below + (s**2 + 2) * density


def with_correlation(length: float, period: int, lay: float = 1.0) -> RandomSurface:
    """A surface of autocorrelation 0.2^((x/λ)² + (y/(γ λ))²), λ in pixels, with ridges along y for γ > 1."""
    decay = math.pi**2 * length**2 / math.log(5)

    def power(kx: Array, ky: Array) -> Array:
        return np.asarray(np.exp(-decay * (kx**2 + (lay * ky) ** 2)))

    return RandomSurface(name="" if lay == 1 else f"lay {lay:g}", power=power, period=period)


def self_affine(hurst: float, roll_off: float, period: int) -> RandomSurface:
    """A self-affine surface from its roll-off down to waves of three pixels."""

    def power(kx: Array, ky: Array) -> Array:
        k = np.hypot(kx, ky)
        return np.asarray(np.maximum(k * roll_off, 1.0) ** (-2 - 2 * hurst) * (k < 1 / 3))

    return RandomSurface(name=f"Hurst {hurst:g}", power=power, period=period)


def wavy(length: float, wavelength: float, part: float, period: int) -> RandomSurface:
    """A surface of correlation length λ with waves around one wavelength whose rms height is a part of the whole Sq."""
    rough = with_correlation(length, period)
    kx, ky = _wave_numbers(period)

    def band(kx: Array, ky: Array) -> Array:
        return np.asarray(np.exp(-0.5 * ((np.hypot(kx, ky) * wavelength - 1) / 0.3) ** 2))

    def variance(power: Array) -> float:
        power[0, 0] = 0.0
        return float(np.fft.irfft2(power, s=(period, period))[0, 0])

    scales = variance(rough.power(kx, ky)), variance(band(kx, ky))

    def power(kx: Array, ky: Array) -> Array:
        return (1 - part**2) * rough.power(kx, ky) / scales[0] + part**2 * band(kx, ky) / scales[1]

    return RandomSurface(name="waves", power=power, period=period)


def geometric(windows: Array) -> Array:
    """The quantities ``GEOMETRIC`` of windows of heights, shape (n, w, w): shape (n, 3)."""
    z = windows - windows.mean(axis=(1, 2), keepdims=True)
    squares = (np.mean(np.diff(z, axis=axis) ** 2, axis=(1, 2)) for axis in (1, 2))
    cubed = np.mean(np.maximum(SEPARATION - z, 0.0) ** 3, axis=(1, 2))
    return np.column_stack([z.std(axis=(1, 2)), np.sqrt(sum(squares)), cubed])


@cache
def pressed_bank(side: int, pixels: int) -> Array:
    """The quantities ``PRESSED`` of windows of a number of pixels with a side in correlation lengths: shape (BANK, 4).

    The windows are cut one side apart, joined, pressed, and permeated along x. A window that seals has a permeability
    of 0.
    """
    from roughfilm.contact.mechanics.press import Press  # numba is slow to import
    from roughfilm.rom.homogenization.cell import solve_cell

    rng = np.random.default_rng([SEED, side])
    surface = with_correlation(pixels / side, 8 * pixels)
    amplitudes, slope = surface.amplitudes(), surface.slope()
    edges = {"direction": "both", "width": f"{max(JOINT_OF_SIDE * pixels, 0.5)} m"}
    recipe = read_recipe({"form": "none", "grid": {"points": "kept"}, "edges": edges, "smoothing": 1})
    rows: list[tuple[float, ...]] = []
    while len(rows) < BANK:
        measured = level(Surface(heights=surface.draw(rng, amplitudes), spacing=(1.0, 1.0)), recipe)
        for i, j in np.ndindex(4, 4):
            window = Window(start=(2 * i * pixels, 2 * j * pixels), shape=(pixels, pixels))
            cell = cell_of(measured, recipe, window).surface
            contact = Press(cell.heights, cell.spacing, MODULUS).at(LOAD * MODULUS * slope)
            try:
                flow = float(solve_cell(contact.gap, cell.spacing).factors.pressure[0, 0])
            except (InputError, ConvergenceError):
                flow = 0.0
            sq, steep, _ = geometric(cell.heights[None])[0]
            rows.append((sq, steep, contact.area_fraction_pixel, flow))
    return np.array(rows[:BANK])


@cache
def scratched_bank(rate: float, pixels: int) -> Array:
    """The quantities ``GEOMETRIC`` of windows with a Poisson number of scratches along x: shape (RARE_BANK, 3)."""
    rng = np.random.default_rng([SEED, round(1000 * rate)])
    surface = with_correlation(pixels / 8, 8 * pixels)
    amplitudes = surface.amplitudes()
    rows: list[Array] = []
    while len(rows) < RARE_BANK:
        heights = surface.draw(rng, amplitudes)
        cut = heights.reshape(8, pixels, 8, pixels).swapaxes(1, 2).reshape(64, pixels, pixels).copy()
        for window, count in zip(cut, rng.poisson(rate, 64), strict=True):
            window[:, rng.integers(0, pixels, count)] -= SCRATCH_DEPTH
        rows.extend(geometric(cut))
    return np.array(rows[:RARE_BANK])


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """Measurements of a surface: name of the row, the surface, and whether a quadratic form is removed."""

    row: str
    surface: RandomSurface
    levelled: bool = False

    def draw(self, rng: np.random.Generator, amplitudes: Array, pixels: int) -> Surface:
        """One measurement of ``pixels`` along each side, cut of a new surface."""
        heights = self.surface.draw(rng, amplitudes)[:pixels, :pixels]
        measured = Surface(heights=heights, spacing=(1.0, 1.0))
        return remove_form(measured, "quadratic") if self.levelled else measured


def measurements(side: int) -> Iterator[Measurement]:
    """Surfaces whose windows of ``side`` pixels are cut from a measurement four times as wide."""
    for ratio in (1.0, 4.0, 16.0):
        if side / ratio >= MIN_PIXELS:
            yield Measurement(row=f"L = {ratio:g} λ", surface=with_correlation(side / ratio, 8 * side))
    for lay in (4, 16, 40):
        yield Measurement(row=f"L = 8 λ, ridges {lay} λ long", surface=with_correlation(side / 8, 16 * side, lay))
    for hurst, ratio in ((0.8, 0.25), (0.8, 1.0), (0.8, 4.0), (0.8, 16.0), (0.3, 1.0), (0.3, 16.0)):
        row = f"Hurst {hurst:g} up to waves of {ratio:g} L"
        surface = self_affine(hurst, ratio * side, 16 * side)
        yield Measurement(row=row + (", form removed" if ratio > 1 else ""), surface=surface, levelled=ratio > 1)


@dataclass(frozen=True, kw_only=True)
class Extrapolation:
    """A surface whose windows of L, L/2 and L/4 are extrapolated.

    Attributes
    ----------
    column : name of the column.
    surface : the surface.
    joined : whether the windows are joined.
    refused : whether the spectrum does not roll off within the windows, so that nothing may be extrapolated.
    """

    column: str
    surface: RandomSurface
    joined: bool = False
    refused: bool = False


def extrapolations(side: int) -> Iterator[Extrapolation]:
    """Surfaces whose windows of ``side`` pixels and less are cut from a measurement four times as wide."""
    period = 8 * side
    for ratio in (24.0, 12.0, 6.0, 3.0):
        if side / ratio >= MIN_PIXELS:
            surface = with_correlation(side / ratio, period)
            yield Extrapolation(column=f"L = {ratio:g} λ", surface=surface, refused=ratio <= 3)
    yield Extrapolation(column="L = 12 λ, joined", surface=with_correlation(side / 12, period), joined=True)
    for hurst, ratio in ((0.8, 0.25), (0.8, 0.5), (0.8, 1.0), (0.8, 4.0), (0.3, 0.25), (0.3, 4.0)):
        surface = self_affine(hurst, ratio * side, period)
        yield Extrapolation(column=f"Hurst {hurst:g} up to {ratio:g} L", surface=surface, refused=ratio >= 1)
    for ratio, part in ((1.0, 0.5), (4.0, 0.2), (4.0, 0.5)):
        surface = wavy(side / 16, ratio * side, part, period)
        yield Extrapolation(column=f"waves of {ratio:g} L, {100 * part:g} % of Sq", surface=surface)
