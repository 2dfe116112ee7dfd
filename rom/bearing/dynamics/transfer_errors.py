"""The errors of stiffness, damping and equilibrium by a heat transfer to the surroundings that is estimated."""

import math
from collections.abc import Callable

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.dynamics.balance import Equilibrium, balanced_equilibrium, point_of
from roughfilm.rom.bearing.dynamics.point import changes_of
from roughfilm.rom.bearing.march.rough_walls import Walls
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.exchange import ESTIMATED


def transfer_errors(scene: Bearing, walls: Walls, found: Equilibrium, ratio: float) -> Callable[[str], float]:
    """The uncertainty of every number of an equilibrium, or of an entry of its whirl, by an estimated heat transfer.

    The heat is balanced again with half and with twice the heat transfer; the larger change of each number counts. It
    is infinite where one of them has no equilibrium, and 0 where the heat transfer is given or none is needed.
    Parameters are those of :func:`roughfilm.rom.bearing.dynamics.wall_errors.wall_errors`.
    """
    if found.temperatures is None or not found.temperatures.estimated:
        return lambda _name: 0.0
    try:
        ends = [
            point_of(balanced_equilibrium(scene, walls, found.cells, coarse=found, part=part), ratio)
            for part in ESTIMATED
        ]
    except (InputError, ConvergenceError):
        return lambda _name: math.inf
    own = point_of(found, ratio)

    def error(name: str) -> float:
        changes = changes_of(name, own, ends)
        return max(changes, default=0.0) if all(map(math.isfinite, changes)) else math.inf

    return error
