"""The totals of a bearing of several equal pieces, of which a scene describes one."""

from collections.abc import Mapping

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.scene import Bearing

WHOLE = "bearing_"
"""Prefix of the names of totals."""

ADDED = (
    "load",
    "friction",
    "power_loss",
    "torque",
    "inlet_flow",
    "outlet_flow",
    "displaced_flow",
    "side_leakage",
    "supply_flow",
    "contact_load",
    "film_load",
    "heat_generated",
    "heat_to_lubricant",
    "heat_to_fixed_wall",
    "heat_to_sliding_wall",
    "heat_to_surroundings",
)
"""Quantities of the pieces that add up to those of the whole bearing."""


def whole_bearing(scene: Bearing, quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """The quantities of a piece and, if the bearing has several, the totals ``bearing_load`` and so on.

    A total is the number of pieces times the quantity of a piece, and so is its uncertainty, as equal pieces have equal
    errors. A bearing of one piece, or of an unknown number, has no totals.

    Parameters
    ----------
    quantities : quantities of one piece, by name.
    """
    count = scene.pieces
    if count is None or count == 1:
        return dict(quantities)
    totals = {
        f"{WHOLE}{name}": Quantity(
            value=count * one.value,
            unit=one.unit,
            uncertainty=None if one.uncertainty is None else count * one.uncertainty,
        )
        for name in ADDED
        if (one := quantities.get(name)) is not None
    }
    return {**quantities, **totals}
