"""The contact algorithm of the thesis, after Stanley and Kato: a fixed-point iteration on the deformed gap."""

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

PLANE_TOLERANCE = 1e-6
"""Default tolerance of the flatness of the plane, over the rms height."""

MAX_ITERATIONS = 50_000
"""Default of the largest number of iterations."""

STEP_LENGTH = 1.9
"""Step of the pressure, over that which removes the longest wave in one step; the iteration diverges from 2 on."""


def stanley_kato(
    heights: Array,
    spacing: tuple[float, float],
    composite_modulus: float,
    load: float,
    *,
    hardness: float = math.inf,
    tolerance: float = PLANE_TOLERANCE,
    most_iterations: int = MAX_ITERATIONS,
) -> Contact:
    """The contact of a periodic surface at one load, by the nine steps of Fig. E.3 of the thesis.

    p ← clip(p − C (u_e + h1) + s, 0, H) with u_e = K∗p and with s such that the mean of p is W, until h1 + u_e is the
    plane g00 where 0 < p < H; then u_p = g00 − (h1 + u_e) where p = H. The thesis leaves C open; here it is
    1.9 π E*/L with L the longer side, nearly the largest with which the longest wave does not grow.

    Parameters
    ----------
    heights : z, shape (nx, ny), m, upward. A side of one node means line contact, in plane strain.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa.
    load : W, mean pressure over the nominal area, Pa; above 0 and at most H.
    hardness : H, Pa.
    tolerance : largest complementarity, over the rms height.
    most_iterations : largest number of iterations.

    Returns
    -------
    Contact : as that of ``Press``, with the complementarity recomputed.

    Raises
    ------
    InputError
        If an argument is out of range or not finite.
    ConvergenceError
        If no elastic node is left, so that the plane is undetermined, or the iterations are used up.

    Notes
    -----
    Shift and clipping give the nearest pressure within the bounds with the same mean, so that this is the projected
    gradient method with constant step. The energy never increases, and errors finally fall by a constant factor, whose
    distance from 1 is about the shortest over the longest wave in a patch of contact. The number of iterations grows
    about as the square root of the nodes along a side: 224 and 570 for 128 and 512 nodes of one rough profile, where
    ``Press`` needs 8 and 14. The order of accuracy is that of ``Press``. In addition to the flatness of the thesis, the
    gap off contact must not be negative and that of plastic nodes not positive. The algorithm fails where no node is
    elastic, for example if the load is carried by a whole number of plastic nodes; ``Press`` does not. Source: thesis,
    E.2.2, Fig. E.3; H. M. Stanley, T. Kato, J. Tribol. 119 (1997) 481, doi:10.1115/1.2833523.
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
            return press.contact_of(load, np.where(pressure >= most, hardness, pressure * composite_modulus), iteration)
        corrected = shifted(pressure - STEP_LENGTH * np.pi * (deformed - plane), mean, most)
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
