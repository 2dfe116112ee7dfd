"""Plateau-honed surfaces: the minimum of fine plateaus and coarse, crossing valleys."""

import math

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import length, number_between, whole_between
from roughfilm.contact.synthetic.gaussian import correlation_lengths, spectrum
from roughfilm.contact.synthetic.grid import Grid, metres, radians
from roughfilm.contact.synthetic.waves import MAX_SEED, random_waves


def plateau_honed(
    *,
    size: tuple[float, float],
    points: tuple[int, int],
    seed: int,
    plateau_rms_height: float,
    plateau_correlation_length: float,
    valley_rms_height: float,
    valley_correlation_length: float,
    material_ratio: float,
    valley_anisotropy: float = 1.0,
    half_angle: float = 0.0,
) -> Surface:
    """The minimum of two Gaussian surfaces, h = min(p, v), of plateaus p and valleys v.

    On a probability plot the bearing curve follows two lines of slopes Spq (plateaus) and Svq (valleys), which cross at
    the material ratio Smq; therefore the mean of v lies (Svq - Spq) Φ⁻¹(Smq) above that of p, which is 0.

    Parameters
    ----------
    size, points : period, m, and number of points, along x and y.
    seed : 0 to 2^63 - 1; plateaus use the seed (seed, 0), valleys (seed, 1), as in ``random_waves``.
    plateau_rms_height, valley_rms_height : Spq <= Svq, m, of each surface before the minimum is taken.
    plateau_correlation_length, valley_correlation_length : correlation length across the lay, m, as in ``gaussian``.
    material_ratio : Smq, 0.0001 to 0.9999.
    valley_anisotropy : correlation length of the valleys along their lay over that across it, 1e-4 to 1e4.
    half_angle : angle between the valleys and the x axis, 0 to π/2 rad; half of their variance lies at +, half at -.

    Returns
    -------
    Surface : periodic; ``source["achieved"]`` holds the lift, the mean of v minus that of p.

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Source: ISO 13565-3:1998 for the two processes; ISO 25178-2:2021 for Spq, Svq, Smq.
    """
    kind = "plateau_honed"
    grid = Grid(kind=kind, size=size, points=points)
    whole_between(f"{kind}.seed", seed, 0, MAX_SEED)
    length(f"{kind}.plateau_rms_height", plateau_rms_height)
    number_between(
        f"{kind}.valley_rms_height",
        valley_rms_height,
        plateau_rms_height,
        1e6,
        f"it must be at least that of the plateaus, {plateau_rms_height!r} m",
    )
    number_between(f"{kind}.material_ratio", material_ratio, 1e-4, 1 - 1e-4, "it must be 0.0001 to 0.9999")
    number_between(f"{kind}.valley_anisotropy", valley_anisotropy, 1e-4, 1e4, "it must be 1e-4 to 1e4")
    number_between(f"{kind}.half_angle", half_angle, 0, math.pi / 2, "it must be 0 to π/2 rad")
    lays = (half_angle, -half_angle)
    valley_lengths = correlation_lengths(
        grid, "valley_correlation_length", valley_correlation_length, valley_anisotropy, *lays
    )
    plateau_lengths = correlation_lengths(grid, "plateau_correlation_length", plateau_correlation_length, 1.0, 0.0)
    cut_off = grid.shortest_wavelength

    def crossing(qx: Array, qy: Array) -> Array:
        one, other = (spectrum(qx, qy, valley_lengths, lay, "gaussian") for lay in lays)
        return one + other

    plateaus = random_waves(
        grid,
        spectrum=lambda qx, qy: spectrum(qx, qy, plateau_lengths, 0.0, "gaussian"),
        cut_off=cut_off,
        seed=(seed, 0),
        rms_height=plateau_rms_height,
    )
    valleys = random_waves(grid, spectrum=crossing, cut_off=cut_off, seed=(seed, 1), rms_height=valley_rms_height)
    lift = (valley_rms_height - plateau_rms_height) * float(scipy.special.ndtri(material_ratio))
    return grid.surface(
        np.minimum(plateaus.heights(points), lift + valleys.heights(points)),
        {
            "seed": seed,
            "plateau_rms_height": metres(plateau_rms_height),
            "plateau_correlation_length": metres(plateau_correlation_length),
            "valley_rms_height": metres(valley_rms_height),
            "valley_correlation_length": metres(valley_correlation_length),
            "material_ratio": material_ratio,
            "valley_anisotropy": valley_anisotropy,
            "half_angle": radians(half_angle),
        },
        {"lift": metres(lift)},
    )
