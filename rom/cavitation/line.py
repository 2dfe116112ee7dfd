"""The Newton step of an infinitely wide film: a tridiagonal system."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import along
from roughfilm.rom.cavitation.network import Network
from roughfilm.rom.cavitation.newton import Linear


def line_step(network: Network, linear: Linear, accuracy: float) -> Array:  # noqa: ARG001
    """The change of every unknown, shape (nx, 1); corners of a periodic film by the Sherman-Morrison formula."""
    lower, centre, upper = (part[:, 0].copy() for part in (linear.west, linear.centre, linear.east))
    change = -linear.balance[:, 0]
    scratch = np.empty_like(change)
    if not network.periodic[0]:
        along(lower, centre, upper, change, scratch)
        return change[:, None]
    first, last = lower[0], upper[-1]
    shift = -centre[0]
    centre[0] -= shift
    centre[-1] -= first * last / shift
    bent = np.zeros_like(change)
    bent[0], bent[-1] = shift, last
    along(lower, centre, upper, change, scratch)
    along(lower, centre, upper, bent, scratch)
    part = (change[0] + first / shift * change[-1]) / (1 + bent[0] + first / shift * bent[-1])
    return np.asarray(change - part * bent)[:, None]
