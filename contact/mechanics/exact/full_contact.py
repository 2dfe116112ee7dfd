"""The pressure in full contact of a sum of waves with a rigid plane."""

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.checks import finite, positive


def full_contact_pressure(
    x: ArrayLike,
    y: ArrayLike,
    *,
    amplitudes: ArrayLike,
    wave_vectors: ArrayLike,
    phases: ArrayLike = 0.0,
    composite_modulus: float,
    load: float,
) -> Array:
    """Pressure that flattens z = Σ A cos(qx x + qy y + φ): p = P + Σ (E* q/2) A cos(qx x + qy y + φ), q = |(qx, qy)|.

    Contact is full if p is nowhere negative, which is certain for P >= Σ (E* q/2) |A|. A plane wave is a line contact:
    z = D cos(2πx/L) is flat from P = πE*D/L on.

    Parameters
    ----------
    x, y : coordinates, m, shapes that broadcast.
    amplitudes : A, shape (n,), m.
    wave_vectors : (qx, qy), shape (n, 2), rad/m; not (0, 0).
    phases : φ, shape (n,) or a number, rad.
    composite_modulus : E*, Pa.
    load : P, mean pressure, Pa.

    Returns
    -------
    Array : p, Pa, broadcast shape of x and y; negative where the load is too low for full contact.

    Raises
    ------
    InputError
        If a number is not finite, the modulus is not above 0, shapes do not match, or a wave vector is 0.

    Notes
    -----
    The pressure is exact for small slopes.

    Source: Johnson, Greenwood and Higginson, Int. J. Mech. Sci. 27 (1985) 383, doi:10.1016/0020-7403(85)90029-3.

    Examples
    --------
    >>> ridge = {"amplitudes": [1e-6], "wave_vectors": [[2e3 * np.pi, 0.0]], "composite_modulus": 1e11}
    >>> round(float(full_contact_pressure(0.0, 0.0, load=4e8, **ridge)) / 1e8 - 4, 12)
    3.14159265359
    """
    modulus = positive("full_contact.composite_modulus", composite_modulus)
    height = finite("full_contact.amplitudes", amplitudes)
    vectors = finite("full_contact.wave_vectors", wave_vectors)
    if height.ndim != 1 or vectors.shape != (height.size, 2):
        raise InputError(
            f"full_contact: got amplitudes of shape {height.shape} and wave vectors of shape {vectors.shape}; "
            "give n amplitudes and n pairs"
        )
    number = np.hypot(*vectors.T)
    if not (number > 0).all():
        raise InputError("full_contact.wave_vectors: got (0, 0); a constant height bears no pressure, leave it out")
    turn = np.broadcast_to(finite("full_contact.phases", phases), height.shape)
    along, across = finite("full_contact.x", x)[..., None], finite("full_contact.y", y)[..., None]
    waves = np.cos(along * vectors[:, 0] + across * vectors[:, 1] + turn)
    return np.asarray(float(finite("full_contact.load", load)) + modulus / 2 * (waves @ (number * height)))
