"""Self-affine surfaces, whose spectrum is a power law between a roll-off and a cut-off wavelength."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import length, number_between, whole_between
from roughfilm.contact.synthetic.grid import Grid, metres
from roughfilm.contact.synthetic.waves import MAX_SEED, Amplitudes, random_waves


def self_affine(
    *,
    size: tuple[float, float],
    points: tuple[int, int],
    seed: int,
    hurst: float,
    roll_off: float,
    cut_off: float,
    rms_height: float | None = None,
    rms_slope: float | None = None,
    amplitudes: Amplitudes = "fixed",
) -> Surface:
    """A random isotropic self-affine surface.

    Its power spectrum is C(q) = C0 for q <= qr, C0 (q/qr)^(-2 - 2H) for qr < q < qs, and 0 from qs on, with
    qr = 2π/roll_off and qs = 2π/cut_off, at all wave vectors of the period except q = 0. It is scaled to the rms height
    or to the rms slope sqrt(<|∇h|²>) of the continuous surface, to rounding.

    Parameters
    ----------
    size, points : period, m, and number of points, along x and y.
    seed : 0 to 2^63 - 1; equal seeds give the same surface on every grid (see ``random_waves``).
    hurst : H, above 0 and at most 1.
    roll_off : wavelength, m, at most the longer side; equal to it, the surface is self-affine up to its own size.
    cut_off : wavelength, m, below the roll-off, at least two pixels.
    rms_height, rms_slope : m, and 1e-12 to 1000; exactly one of them.
    amplitudes : "fixed": every seed has this spectrum; "random": only the mean over seeds has it.

    Returns
    -------
    Surface : periodic, of mean 0; ``source["achieved"]`` holds rms height, rms slope and number of waves.

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Heights approach a Gaussian distribution as the number of waves near the roll-off grows.

    Source: Persson et al., J. Phys. Condens. Matter 17 (2005) R1, doi:10.1088/0953-8984/17/1/R01.
    """
    grid = Grid(kind="self_affine", size=size, points=points)
    whole_between("self_affine.seed", seed, 0, MAX_SEED)
    number_between("self_affine.hurst", hurst, 1e-6, 1, "it must be above 0 and at most 1")
    length("self_affine.roll_off", roll_off)
    grid.resolves("cut_off", cut_off)
    if roll_off > max(size) * (1 + 1e-9):
        raise InputError(
            f"self_affine.roll_off: got {roll_off:.5g} m, beyond the longer side; write at most {max(size):.5g} m"
        )
    if cut_off >= roll_off:
        raise InputError(
            f"self_affine.cut_off: got {cut_off:.5g} m, not below the roll-off of {roll_off:.5g} m; write a shorter one"
        )
    if (rms_height is None) == (rms_slope is None):
        given = "neither" if rms_height is None else "both"
        raise InputError(f"self_affine: got {given} of rms_height and rms_slope; give exactly one")
    if rms_height is not None:
        length("self_affine.rms_height", rms_height)
    if rms_slope is not None:
        number_between("self_affine.rms_slope", rms_slope, 1e-12, 1e3, "it must be 1e-12 to 1000")

    def spectrum(qx: Array, qy: Array) -> Array:
        beyond: Array = np.maximum(np.hypot(qx, qy) * roll_off / (2 * np.pi), 1.0)
        return beyond ** (-2 - 2 * hurst)

    waves = random_waves(
        grid,
        spectrum=spectrum,
        cut_off=cut_off,
        seed=seed,
        amplitudes=amplitudes,
        rms_height=rms_height,
        rms_slope=rms_slope,
    )
    return grid.surface(
        waves.heights(points),
        {
            "seed": seed,
            "hurst": hurst,
            "roll_off": metres(roll_off),
            "cut_off": metres(cut_off),
            "rms_height": metres(rms_height),
            "rms_slope": rms_slope,
            "amplitudes": amplitudes,
        },
        {"rms_height": metres(waves.rms_height), "rms_slope": waves.rms_slope, "waves": 2 * waves.m.size},
    )
