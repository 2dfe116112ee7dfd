"""Gaussian surfaces with a given autocorrelation length and anisotropy."""

import math
from typing import Literal

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import length, number_between, whole_between
from roughfilm.contact.synthetic.grid import Grid, metres, radians
from roughfilm.contact.synthetic.waves import MAX_SEED, Amplitudes, random_waves

Autocorrelation = Literal["gaussian", "exponential"]

CORRELATION_LEVEL = 0.2
"""Autocorrelation that defines the correlation length, as for Sal in ISO 25178-2."""


def gaussian(
    *,
    size: tuple[float, float],
    points: tuple[int, int],
    seed: int,
    rms_height: float,
    correlation_length: float,
    anisotropy: float = 1.0,
    lay_angle: float = 0.0,
    autocorrelation: Autocorrelation = "gaussian",
    amplitudes: Amplitudes = "fixed",
) -> Surface:
    """A random surface with Gaussian heights and a given autocorrelation.

    R(t) = 0.2^(ρ²) ("gaussian") or 0.2^ρ ("exponential"), with ρ² = (t_along / (γ λ))² + (t_across / λ)². Across the
    lay R falls to 0.2 at λ, so that Sal = λ and Str = 1/γ for γ >= 1.

    Parameters
    ----------
    size, points : period, m, and number of points, along x and y.
    seed : 0 to 2^63 - 1; the same surface for the same seed (see ``random_waves``).
    rms_height : m; met to rounding.
    correlation_length : λ across the lay, m; at least two pixels. ``correlation_length_at`` converts between lengths
        defined at 0.2, 1/e and 0.5.
    anisotropy : γ, correlation length along the lay over that across it, 1e-4 to 1e4. For lay angle 0 it is λx/λy, the
        γ of Patir and Cheng for flow along x: above 1 for ridges along the flow, below 1 for ridges across it.
    lay_angle : angle from x towards y, -7 to 7 rad.
    autocorrelation : "gaussian" (smooth) or "exponential" (rough down to the pixel).
    amplitudes : "fixed": every seed has this autocorrelation; "random": only the mean over seeds has it.

    Returns
    -------
    Surface : periodic, of mean 0; ``source["achieved"]`` holds the rms slope.

    Raises
    ------
    InputError
        If an argument is out of range, or R exceeds 0.2 at half a period along x or y.

    Notes
    -----
    Waves shorter than two pixels are left out. For "gaussian" they carry 0.2 % of the variance if λ is two pixels and
    1e-10 if four, so that a finer grid gives the same surface; for "exponential" about dx/(2λ), which is distributed
    over the other waves. The wave q = 0 is left out too, which lowers R by about 2 λ² γ / (Lx Ly) everywhere.

    Sources: ISO 25178-2:2021; Patir and Cheng, J. Lubr. Technol. 100 (1978) 12, doi:10.1115/1.3453103.
    """
    grid = Grid(kind="gaussian", size=size, points=points)
    whole_between("gaussian.seed", seed, 0, MAX_SEED)
    length("gaussian.rms_height", rms_height)
    number_between("gaussian.lay_angle", lay_angle, -7, 7, "it must be -7 to 7 rad")
    if autocorrelation not in ("gaussian", "exponential"):
        raise InputError(f"gaussian.autocorrelation: got {autocorrelation!r}; write 'gaussian' or 'exponential'")
    number_between("gaussian.anisotropy", anisotropy, 1e-4, 1e4, "it must be 1e-4 to 1e4")
    lengths = correlation_lengths(grid, "correlation_length", correlation_length, anisotropy, lay_angle)
    waves = random_waves(
        grid,
        spectrum=lambda qx, qy: spectrum(qx, qy, lengths, lay_angle, autocorrelation),
        cut_off=grid.shortest_wavelength,
        seed=seed,
        amplitudes=amplitudes,
        rms_height=rms_height,
    )
    return grid.surface(
        waves.heights(points),
        {
            "seed": seed,
            "rms_height": metres(rms_height),
            "correlation_length": metres(correlation_length),
            "anisotropy": anisotropy,
            "lay_angle": radians(lay_angle),
            "autocorrelation": autocorrelation,
            "amplitudes": amplitudes,
        },
        {"rms_height": metres(waves.rms_height), "rms_slope": waves.rms_slope},
    )


def correlation_lengths(
    grid: Grid, name: str, across: float, anisotropy: float, *lay_angles: float
) -> tuple[float, float]:
    """Correlation lengths along and across the lay, m; raises InputError if grid or period do not fit them."""
    along = anisotropy * length(f"{grid.kind}.{name}", across)
    grid.resolves(name, min(along, across))
    for lay in lay_angles:
        extents = (
            math.hypot(along * math.cos(lay), across * math.sin(lay)),
            math.hypot(along * math.sin(lay), across * math.cos(lay)),
        )
        for axis, extent, side in zip("xy", extents, grid.size, strict=True):
            if extent > side / 2 * (1 + 1e-9):
                raise InputError(
                    f"{grid.kind}.{name}: got an autocorrelation that reaches {extent:.5g} m along {axis}, beyond half "
                    f"the period; write at most {across * side / 2 / extent:.5g} m, or a longer size"
                )
    return along, across


def spectrum(qx: Array, qy: Array, lengths: tuple[float, float], lay: float, autocorrelation: Autocorrelation) -> Array:
    """The spectrum of R up to a constant factor: exp(-s²/(4 ln 5)) or (1 + s²/ln²5)^(-3/2).

    Parameters
    ----------
    qx, qy : wave vector, rad/m, any shape.
    lengths : (γ λ, λ), m; s² = (q_along γ λ)² + (q_across λ)².
    lay : angle from x towards y, rad.
    """
    along = (qx * math.cos(lay) + qy * math.sin(lay)) * lengths[0]
    across = (qy * math.cos(lay) - qx * math.sin(lay)) * lengths[1]
    squared = along**2 + across**2
    decay = -math.log(CORRELATION_LEVEL)
    gaussian_form = autocorrelation == "gaussian"
    return np.asarray(np.exp(-squared / (4 * decay)) if gaussian_form else (1 + squared / decay**2) ** -1.5)


def correlation_length_at(
    level: float, correlation_length: float, autocorrelation: Autocorrelation = "gaussian"
) -> float:
    """Distance at which R = s, m: λ sqrt(ln s / ln 0.2) ("gaussian") or λ ln s / ln 0.2 ("exponential").

    Parameters
    ----------
    level : s, between 0 and 1; 0.5 for the length of Patir and Cheng, 1/e for that of most texts.
    correlation_length : distance λ at which R = 0.2, m.

    Raises
    ------
    InputError
        If the level is not between 0 and 1.

    Examples
    --------
    >>> round(1e6 * correlation_length_at(0.5, 20e-6), 3)  # um
    13.125
    >>> round(20 / correlation_length_at(0.5, 1.0), 3)  # um: λ for which R is 0.5 at 20 um
    30.476
    """
    number_between("level", level, 1e-300, 1 - 1e-12, "it must be between 0 and 1")
    ratio = math.log(level) / math.log(CORRELATION_LEVEL)
    return correlation_length * (math.sqrt(ratio) if autocorrelation == "gaussian" else ratio)
