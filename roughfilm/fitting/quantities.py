"""Contact pressure, mean gap and leakage of cells, by which seeds of a description are compared with windows."""

from collections.abc import Sequence

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import number_between
from roughfilm.rom.seal.leakage.direct import direct_flow

NAMES = ("contact pressure", "mean gap", "leakage along x", "leakage along y")
"""Quantities of a cell: mean pressure on the real contact area over E*, mean gap, m, and permeabilities K, m³."""

CONTACT_TOLERANCE = 1e-6
"""Largest violation of the contact conditions over the rms height."""

FLOW_TOLERANCE = 1e-3
"""Largest relative solver error of a permeability, far below the scatter between windows."""

LIGHT_CONTACT_RATIO = 2.1
"""The ratio A E* g'/P in light contact, with the contact area fraction A, the rms slope g' and the mean pressure P."""

SAMPLE = 12
"""Largest number of cells by which a load is chosen."""

AREA_TOLERANCE = 0.02
"""Relative deviation of the mean area fraction of these cells from the one that is sought."""


def quantities_of(cell: Surface, load: float) -> Array:
    """The quantities ``NAMES`` of an elastic cell under a mean pressure over E*, shape (4,); NaN without convergence.

    A sealed direction has the permeability 0.
    """
    try:
        contact = Press(cell.heights, cell.spacing, 1.0).at(load, tolerance=CONTACT_TOLERANCE)
        flows = [direct_flow(contact.gap, cell.spacing, axis, tolerance=FLOW_TOLERANCE).permeability for axis in (0, 1)]
    except ConvergenceError:
        return np.full(len(NAMES), np.nan)
    return np.array([load / contact.area_fraction, contact.mean_gap, *flows])


def refuse_area(area: float) -> None:
    """Raise InputError unless a contact area fraction is 0.1 % to 90 %."""
    number_between("area", area, 0.001, 0.9, "give a fraction of 0.1 % to 90 %")


def load_at_area(cells: Sequence[Surface], area: float) -> float:
    """The mean pressure over E* at which the mean contact area fraction of cells has a value between 0 and 1.

    Raises
    ------
    InputError
        If the fraction is out of range.
    """
    refuse_area(area)
    some = cells[:: max(1, len(cells) // SAMPLE)]
    slope = float(np.mean([wave_power(cell.heights, cell.spacing).moments.rms_slope for cell in some]))
    bodies = [Press(cell.heights, cell.spacing, 1.0) for cell in some]
    load = area * slope / LIGHT_CONTACT_RATIO
    for _ in range(20):
        found = float(np.mean([body.at(load, tolerance=1e-4).area_fraction for body in bodies]))
        if abs(found / area - 1) < AREA_TOLERANCE:
            break
        load *= min(max(area / found, 0.2), 5.0)
    return load
