"""The filling of a film: its density ratio, and the filled fraction of cavities."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.solve import Solution


def density_ratio(solution: Solution) -> Array:
    """The density ratio θ at the nodes, shape (nx, ny), in cavities that of the liquid that flows out of the node."""
    film = 1 + solution.problem.compression(solution.state.pressure)[0]
    return np.where(solution.kind == CAVITY, np.minimum(filled_fraction(solution), 1.0), film)


def filled_fraction(solution: Solution) -> Array:
    """The filled fraction of each node according to the flow out of it."""
    mean, rough = solution.faces.mean, solution.faces.averaged
    thickness = solution.faces.thickness if rough is None else rough.drag
    return np.asarray(carried(solution) * np.where(mean > 0, mean, thickness) / thickness)


def carried(solution: Solution) -> Array:
    """ξ of each node, in cavities the flow out of the node over that through the whole face full of liquid."""
    mean, fill = solution.faces.mean, solution.state.fill
    parts = solution.faces.parts[0, : len(solution.network.part_couette)]
    share = np.divide(np.minimum(mean, parts.min(axis=0, initial=np.inf)), mean, out=np.ones_like(mean), where=mean > 0)
    return np.where(solution.kind == CAVITY, share * fill, fill)
