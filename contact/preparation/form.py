"""Step 1 of the preparation: remove the form of the specimen."""

from typing import Literal, get_args

import numpy as np
from numpy.polynomial import legendre

from roughfilm.contact.foundation.arrays import Array, Mask, beyond_rounding
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface

Form = Literal["none", "mean", "tilt", "quadratic", "cubic", "quartic", "quintic", "sextic"]

ORDERS: dict[Form, int] = {"mean": 0, "tilt": 1, "quadratic": 2, "cubic": 3, "quartic": 4, "quintic": 5, "sextic": 6}
"""Order of the polynomial for each form."""


def remove_form(surface: Surface, form: Form, *, ignored: Mask | None = None) -> Surface:
    """Subtract the polynomial in x and y that fits the valid points best in the least-squares sense.

    The polynomial minimises Σ (h − Σ c_ij x^i y^j)² over the valid points with i + j ≤ 0 (``"mean"``), 1 (``"tilt"``),
    2 (``"quadratic"``) and so on to 6 (``"sextic"``); Legendre polynomials keep the normal equations well conditioned.
    A form of this order is removed to rounding. ``"none"`` returns the surface unchanged.

    A sphere or a cylinder of radius R leaves a height of the order a⁴/(8 R³) after ``"quadratic"`` and a⁶/(16 R⁵) after
    ``"quartic"``, with a half of the longer side.

    Parameters
    ----------
    form : the polynomial.
    ignored : mask of valid points that the fit leaves out, shape (nx, ny), such as spikes.

    Returns
    -------
    Surface : no longer periodic after ``"tilt"`` or a higher order.

    Raises
    ------
    InputError
        If the form is unknown, or the valid points do not determine it (all on one line, for example).

    Notes
    -----
    This is the F-operation of ISO 25178-2; waves as long as a side, and for higher orders shorter ones, lose height.
    """
    if form == "none":
        return surface
    if form not in ORDERS:
        raise InputError(f"form: got {form!r}; it must be one of {', '.join(get_args(Form))}")
    order = ORDERS[form]
    terms = [(i, j) for i in range(order + 1) for j in range(order + 1 - i)]
    x, y = (np.asarray(legendre.legvander(np.linspace(-1, 1, n), order), dtype=float) for n in surface.shape)
    fitted = surface.valid if ignored is None else surface.valid & ~ignored
    valid = fitted.astype(np.float64)
    heights = np.where(fitted, surface.heights, 0.0)
    rows, columns = np.transpose(terms)
    # Σ valid P_i(x) P_k(x) P_j(y) P_l(y), summed over y first, avoids a matrix of points by terms.
    along_y = (valid @ (y[:, :, None] * y[:, None, :]).reshape(y.shape[0], -1)).reshape(-1, order + 1, order + 1)
    sums = np.einsum("ai,ak,ajl->ijkl", x, x, along_y, optimize=True)
    normal = sums[rows[:, None], columns[:, None], rows, columns]
    right = (x.T @ (heights @ y))[rows, columns]
    if np.linalg.matrix_rank(normal, tol=1e-12 * valid.sum()) < len(terms):
        raise InputError(
            f"form: the valid points do not determine a form {form!r}; choose a simpler one, such as 'mean'"
        )
    coefficients = np.zeros((order + 1, order + 1))
    coefficients[rows, columns] = np.linalg.solve(normal, right)
    shape: Array = x @ coefficients @ y.T
    heights = np.where(surface.invalid, 0.0, surface.heights - shape)
    heights = beyond_rounding(heights, surface.heights)
    return surface.with_heights(heights, periodic=surface.periodic and order == 0)
