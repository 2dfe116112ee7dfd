"""The quantities of a rough gap: flow and friction coefficients."""

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls


def coefficients(factors: RoughGapFactors) -> dict[str, float]:
    """The coefficients by the names of their quantities; B and friction only if the upper wall can slide."""
    a = {f"A{i + 1}{j + 1}": float(factors.pressure[i, j]) for i in range(2) for j in range(2)}
    if np.isnan(factors.friction):
        return a
    return {**a, "B1": float(factors.shear[0]), "B2": float(factors.shear[1]), "friction": factors.friction}


def known_uncertainties(uncertainty: RoughGapFactors, walls: Walls) -> dict[str, float]:
    """The uncertainties by the names of their quantities, without that of friction where the walls touch.

    The gap goes to 0 at the rim of a contact, and the shear across it without limit: friction does not converge.
    """
    found = coefficients(uncertainty)
    if walls.touch:
        found.pop("friction", None)
    return found


def gap_quantities(scene: RoughGap, walls: Walls, factors: RoughGapFactors) -> dict[str, Quantity]:
    """The quantities of a rough gap from its factors over those of a smooth gap with the thickness of the mean gap.

    Flows per width are those under the scene's gradient along x and along y.
    """
    smooth = scene.nominal_flow
    along, across = (float(factors.pressure[i, i]) for i in range(2))
    return {
        **{name: _number(value) for name, value in coefficients(factors).items()},
        "flow_per_width_x": Quantity(value=along * smooth, unit="m^2/s"),
        "flow_per_width_y": Quantity(value=across * smooth, unit="m^2/s"),
        "mean_gap": Quantity(value=walls.mean_gap, unit="m"),
        "rms_height": Quantity(value=scene.rms_height, unit="m"),
        "contact_area": _number(float(np.mean(walls.gap == 0))),
    }


def _number(value: float) -> Quantity:
    return Quantity(value=value, unit="1")
