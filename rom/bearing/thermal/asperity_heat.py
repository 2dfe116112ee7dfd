"""The heat of asperities in contact: a part of the dissipation of a film."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.solve import Solution


def asperity_heat(solution: Solution, force: Array, friction: float | Array) -> Array:
    """The heat μ p_c u that boundary friction makes on the control volume of each node, W (W/m if infinitely wide).

    The asperities press on a control volume with the force ∫ p_c dA; on a ring the speed is ω r. The sum is the part of
    ``power_loss`` by boundary friction, in which the coefficient is uniform.

    Parameters
    ----------
    solution : the film, whose grid and speed count.
    force : contact force of the asperities on each node, N (N/m if infinitely wide), shape (nx, ny)
        (:func:`roughfilm.rom.bearing.mixed.contact_load.asperity_load`).
    friction : coefficient μ of boundary friction, one number or one for each node, shape (nx, ny).

    Returns
    -------
    array of the shape of ``force``.

    Examples
    --------
    >>> import roughfilm.rom.cavitation.problem as cavitation
    >>> from roughfilm.rom.bearing.geometry.shapes import Parallel
    >>> from roughfilm.rom.cavitation.discretise import Ends
    >>> from roughfilm.rom.cavitation.solve import solve
    >>> shape = Parallel(shape="parallel", length="20 mm", film="1 um").film_shape()
    >>> film = solve(cavitation.Problem(shape=shape, ends=Ends(inlet=0.0), speed=2.0, viscosity=0.05), (4, 4))
    >>> asperity_heat(film, np.full(film.grid.shape, 100.0), 0.1)[:, 0].tolist()
    [20.0, 20.0, 20.0, 20.0, 20.0]
    """
    speed = abs(solution.problem.speed) * (solution.grid.radius if solution.problem.shape.polar else 1.0)
    return np.asarray(friction * force * speed)
