"""Plateau-honed surfaces: the lower of fine plateaus and coarse, crossing valleys."""

import math

import numpy as np
import scipy

from roughfilm.contact.surfaces.surface import Array, Surface
from roughfilm.contact.synthetic.checks import length, number_between, whole_between
from roughfilm.contact.synthetic.gaussian import correlation_lengths, spectrum
from roughfilm.contact.synthetic.grid import Grid, metres, radians
from roughfilm.contact.synthetic.waves import LARGEST_SEED, random_waves


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
    """The lower of two Gaussian surfaces, h = min(p, v): plateaus p, and valleys v that are lifted above them.

    On a probability plot the bearing curve follows two lines, of slopes Spq (plateaus) and Svq (valleys), which cross
    at the material ratio Smq; for that the mean of v lies (Svq - Spq) Φ⁻¹(Smq) above that of p, which is height 0.

    Parameters
    ----------
    size, points : the period, m, and the grid over it, along x and y.
    seed : 0 to 2^63 - 1; plateaus are drawn with (seed, 0), valleys with (seed, 1), as in ``random_waves``.
    plateau_rms_height, valley_rms_height : Spq <= Svq, m, of each surface before the lower is taken.
    plateau_correlation_length, valley_correlation_length : m, across the lay, as in ``gaussian``.
    material_ratio : Smq, 0.0001 to 0.9999: the greater, the more plateau.
    valley_anisotropy : correlation length of the valleys along their lay over that across.
    half_angle : between the valleys and the x axis, rad: half of their variance at +, half at -, so that they cross.

    Returns
    -------
    Periodic surface; ``source["achieved"]`` tells by how much the valleys are lifted.

    Raises
    ------
    InputError
        One line, for what makes no sense.

    Notes
    -----
    Source: the two processes behind ISO 13565-3:1998; Spq, Svq, Smq of ISO 25178-2:2021.
    """
    kind = "plateau_honed"
    grid = Grid(kind=kind, size=size, points=points)
    whole_between(f"{kind}.seed", seed, 0, LARGEST_SEED)
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
