"""The contact algorithm of the thesis, after Stanley and Kato: pressures corrected by the deformed gap."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.contact.mechanics.checks import positive
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.half_space import HalfSpace
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.projected_gradients import plane_of, violation_of
from roughfilm.contact.mechanics.starts import shifted

TOLERANCE = 1e-6
"""Of the plane, over the rms height."""

MOST_ITERATIONS = 50_000

STEP = 1.9
"""The correction of the pressure, over that which undoes the longest wave at once; from 2 on it grows."""


def stanley_kato(
    heights: Array,
    spacing: tuple[float, float],
    composite_modulus: float,
    load: float,
    *,
    hardness: float = math.inf,
    tolerance: float = TOLERANCE,
    most_iterations: int = MOST_ITERATIONS,
) -> Contact:
    """The periodic contact that ``Press`` finds too, by the nine steps of Fig. E.3 of the thesis.

    p ← clip(p − C (u_e + h1) + s, 0, H) with u_e = K∗p and with s such that the mean of p is W, until h1 + u_e is the
    plane g00 where 0 < p < H; then u_p = g00 − (h1 + u_e) where p = H. The thesis leaves C open; here it is
    1.9 π E*/L with L the longer side, nearly the largest with which the longest wave does not grow.

    Parameters
    ----------
    heights : z, shape (nx, ny), m, upward. A side of one node makes it line contact, in plane strain.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa.
    load : W, mean pressure over the nominal area, Pa; above 0 and at most H.
    hardness : H, Pa.
    tolerance : of the complementarity, over the rms height.

    Returns
    -------
    The contact, certified as that of ``Press``.

    Raises
    ------
    InputError
        If something is out of range or not finite.
    ConvergenceError
        If no elastic node is left to fix the plane, or the iterations are used up.

    Notes
    -----
    The shift and the cut together are the nearest pressure within the bounds of the same mean, so that this is the
    projected gradient method with a constant step: the energy never rises, and in the end errors fall by a constant
    factor, whose distance from 1 is about the shortest wave over the longest that a patch of contact holds. Iterations
    grow about as the root of the number of nodes along a side: 224 and 570 for 128 and 512 of one rough profile, where
    ``Press`` takes 8 and 14. The order of accuracy is that of ``Press``. Beyond the flatness of the thesis, a node off
    contact must not pierce the plane nor a plastic one stay short of it: with one elastic node any plane is flat.
    Where no node is elastic, as when the load is a whole number of nodes at the hardness, there is no plane, and the
    algorithm fails; ``Press`` does not. Source: thesis, E.2.2, Fig. E.3; H. M. Stanley, T. Kato, J. Tribol. 119 (1997)
    481, doi:10.1115/1.2833523.
    """
    press = Press(heights, spacing, composite_modulus, hardness=hardness)
    positive("stanley_kato.tolerance", tolerance)
    if positive("stanley_kato.load", load) > hardness:
        raise InputError(f"stanley_kato.load: got {load:g} Pa, above the hardness of {hardness:g} Pa; lower it")
    if load == hardness:
        return press.at(load)
    length = max(n * d for n, d in zip(press.heights.shape, press.spacing, strict=True))
    half_space = HalfSpace(press.heights.shape, (press.spacing[0] / length, press.spacing[1] / length), "periodic")
    down = (press.heights.mean() - press.heights) / length
    unit = float(down.std()) or load / composite_modulus
    mean, most = load / composite_modulus, hardness / composite_modulus
    pressure = np.full(down.shape, mean)
    for iteration in range(most_iterations + 1):
        deformed = down + half_space.displacement(pressure)
        plane = plane_of(pressure, deformed, most)
        elastic = bool(((pressure > 0) & (pressure < most)).any())
        if elastic and violation_of(pressure, deformed, plane, most) <= tolerance * unit:
            found = np.where(pressure >= most, hardness, pressure * composite_modulus)
            return press.contact_of(load, found, iteration)
        corrected = shifted(pressure - STEP * np.pi * (deformed - plane), mean, most)
        if not elastic and np.array_equal(corrected, pressure):
            raise ConvergenceError(
                f"stanley_kato: no elastic node is left after {iteration} iterations, so that nothing fixes the plane; "
                "change the load a little or take elastic_plastic",
                outcome=Outcome.STALLED,
                iterations=iteration,
            )
        pressure = corrected
    raise ConvergenceError(
        f"stanley_kato: unfinished after {most_iterations} iterations, the plane not flat to {tolerance:.2g} of the "
        "rms height; allow more, ask for less or take elastic_plastic",
        outcome=Outcome.UNFINISHED,
        iterations=most_iterations,
    )
