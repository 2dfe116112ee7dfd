"""Step 1: the shape of the specimen, taken away so that roughness is left."""

from typing import Literal, get_args

import numpy as np
from numpy.polynomial import legendre

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface

Form = Literal["none", "mean", "tilt", "quadratic"]

ORDERS: dict[Form, int] = {"mean": 0, "tilt": 1, "quadratic": 2}


def remove_form(surface: Surface, form: Form) -> Surface:
    """Subtract the polynomial in x and y that fits the valid points best.

    Minimises Σ (h − Σ c_ij x^i y^j)² over the valid points, i + j ≤ 0 (``"mean"``), 1 (``"tilt"``) or 2
    (``"quadratic"``), with Legendre polynomials so that the normal equations stay well conditioned. ``"none"`` leaves
    the surface as it is. Exact to rounding for a form of that order. What was tilted or bent is no longer periodic.

    Raises
    ------
    InputError
        If the valid points are too few, or lie so that they do not tell the form (all on one line, say).

    Notes
    -----
    ISO 25178-2 calls this the F-operation.
    """
    if form == "none":
        return surface
    if form not in ORDERS:
        raise InputError(f"form: got {form!r}; it must be one of {', '.join(get_args(Form))}")
    order = ORDERS[form]
    terms = [(i, j) for i in range(order + 1) for j in range(order + 1 - i)]
    x, y = (np.asarray(legendre.legvander(np.linspace(-1, 1, n), order), dtype=float) for n in surface.shape)
    valid = surface.valid.astype(np.float64)
    # Σ valid P_i(x) P_k(x) P_j(y) P_l(y), summed over one direction at a time: no matrix of points by terms.
    along_y = {(j, m): valid @ (y[:, j] * y[:, m]) for _, j in terms for _, m in terms}
    normal = np.array([[(x[:, i] * x[:, k]) @ along_y[j, m] for k, m in terms] for i, j in terms])
    right = np.array([x[:, i] @ (surface.heights @ y[:, j]) for i, j in terms])
    if np.linalg.matrix_rank(normal, tol=1e-12 * valid.sum()) < len(terms):
        raise InputError(f"form: the valid points do not tell a form {form!r}; choose a simpler one, such as 'mean'")
    found = np.zeros((order + 1, order + 1))
    found[tuple(np.transpose(terms))] = np.linalg.solve(normal, right)
    shape: Array = x @ found @ y.T
    heights = np.where(surface.invalid, 0.0, surface.heights - shape)
    return surface.with_heights(heights, periodic=surface.periodic and order == 0)
