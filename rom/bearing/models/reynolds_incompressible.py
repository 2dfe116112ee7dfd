"""The Reynolds equation with cavitation for constant density and viscosity."""

import numpy as np

from roughfilm.rom.bearing.model import SOURCES, bearing_model, incompressible_film
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: Bearing) -> Applicability:
    """Always, with the changes of density and viscosity that are left out."""
    lubricant, pressure = scene.lubricant, np.array([scene.load_pressure or scene.pressure_unit / 10])
    with np.errstate(all="ignore"):
        denser = lubricant.compressibility.compression(pressure)[0][0]
        thicker = 1 / lubricant.piezoviscosity.fluidity(pressure, lubricant.viscosity)[0][0] - 1
    change = f"density by {100 * denser:.2g} % and viscosity by {100 * thicker:.2g} % at {pressure[0]:.2g} Pa"
    return Applicability(applies=True, reason=f"leaves out changes under pressure: {change}")


MODEL = bearing_model(
    name="reynolds_incompressible",
    summary="adds cavitation; incompressible",
    keeps=frozenset({Effect.SIDE_FLOW, Effect.CAVITATION}),
    sources=SOURCES,
    applies=applies,
    film=incompressible_film,
)
