"""The quantities of the cavities of a film."""

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.evaluation.filling import density_ratio
from roughfilm.rom.cavitation.solve import Solution


def cavity_quantities(solution: Solution) -> dict[str, Quantity]:
    """The part of the area in which the film is ruptured, and the least fraction of the gap that is full."""
    areas = solution.grid.areas
    return {
        "cavitated_fraction": Quantity(value=float(areas[solution.kind == CAVITY].sum() / areas.sum()), unit="1"),
        "theta_min": Quantity(value=float(density_ratio(solution).min()), unit="1"),
    }
