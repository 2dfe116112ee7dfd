"""What the supplies of a bearing give to its film."""

import math

import numpy as np

from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.evaluation.flows import node_balances
from roughfilm.rom.cavitation.solve import Solution

MAX_LAMINAR = 2000.0
"""Largest Reynolds number of a capillary whose flow is laminar."""

MIN_ORIFICE = 15.0
"""Smallest Reynolds number of an orifice from which on its discharge coefficient is about constant."""


def supply_values(scene: Bearing, solution: Solution) -> dict[str, tuple[float, str]]:
    """The flow of each supply into the film, its pressure above ambient in the film, and the total flow, with units.

    A flow is the sum of the balances of the control volumes of a supply; in a steady film the flows of all supplies and
    the inlet together are those through the outlet and the sides.
    """
    inflows = solution.problem.inflows
    if not inflows:
        return {}
    balances = node_balances(solution)
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    suffix, unit = ("_per_width", "m^2/s") if solution.problem.shape.wide else ("", "m^3/s")
    values: dict[str, tuple[float, str]] = {}
    total = 0.0
    for number, inflow in enumerate(inflows, start=1):
        nodes = inflow.covers(x, y)
        flow = float(balances[nodes].sum())
        total += flow
        pressure = float(solution.state.pressure[nodes][0]) + scene.lubricant.cavitation_pressure
        values[f"supply_{number}_flow{suffix}"] = flow, unit
        values[f"supply_{number}_pressure"] = pressure, "Pa"
    return {f"supply_flow{suffix}": (total, unit), **values}


def supply_warnings(scene: Bearing, solution: Solution) -> list[str]:
    """Warnings about restrictors outside of the range of their laws, if the density is known, and about flows back."""
    values, warnings = supply_values(scene, solution), []
    for number, (supply, lubricant) in enumerate(zip(scene.supply, scene.supplied, strict=True), start=1):
        density, viscosity = lubricant.density, lubricant.viscosity
        flow = next(value for name, (value, _) in values.items() if name.startswith(f"supply_{number}_flow"))
        if flow < 0:
            warnings.append(f"supply {number} takes {-flow:.3g} {'m^2/s' if scene.wide else 'm^3/s'} from the film")
        if density is None:
            continue
        if supply.capillary is not None:
            reynolds = 4 * density * abs(flow) / (math.pi * viscosity * supply.capillary.diameter)
            if reynolds > MAX_LAMINAR:
                warnings.append(
                    f"supply {number}, capillary: the Reynolds number is {reynolds:.3g}; its law holds up to "
                    f"{MAX_LAMINAR:g}; take a narrower or a longer one"
                )
        if supply.orifice is not None:
            reynolds = 4 * density * abs(flow) / (math.pi * viscosity * supply.orifice.diameter)
            if reynolds < MIN_ORIFICE:
                warnings.append(
                    f"supply {number}, orifice: the Reynolds number is {reynolds:.3g}; its coefficient is constant "
                    f"from {MIN_ORIFICE:g} on; take a capillary"
                )
    return warnings
