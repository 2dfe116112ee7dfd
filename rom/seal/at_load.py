"""Contact and leakage of a whole seal at one load."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.discretisation import uncertainties
from roughfilm.rom.seal.leakage.pixels import with_pixels
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.models.direct_leakage import flow, periods
from roughfilm.rom.seal.scene import Seal


@dataclass(frozen=True, kw_only=True)
class SealAtLoad:
    """A seal at one load.

    Attributes
    ----------
    load : mean pressure over the nominal area, Pa.
    leakage_per_width : through all periods of the length of the seal, in the direction of the scene, kg/(s m).
    area_fraction : contact area over the nominal area.
    mean_gap : mean gap, m.
    sealed : whether there is no open path.
    periods : number of periods of the surface along the flow.
    """

    load: float
    leakage_per_width: Quantity
    area_fraction: Quantity
    mean_gap: Quantity
    sealed: bool
    periods: int


def seal_at_load(scene: Seal, contact: Contact) -> SealAtLoad:
    """The answer of the model ``direct_leakage`` for a contact that is solved already.

    The uncertainties are those by the pixels of the contact; the one of the leakage contains that of the flow through
    the gap on its grid. That of a flat surface is 0, and that of a sealed gap is the flow through coarser grids.

    Parameters
    ----------
    scene : the seal; its load is not used.
    contact : the contact of its surface, shape (nx, ny), nx, ny >= 2.
    """
    passage = with_pixels(flow(contact, scene), contact, scene.axis)
    flat = float(np.ptp(contact.heights)) == 0
    pixels = {"area_fraction": 0.0, "mean_gap": 0.0} if flat else uncertainties(contact)
    return SealAtLoad(
        load=contact.load,
        leakage_per_width=Quantity(
            value=leakage_of(scene, passage.permeability),
            unit="kg/(m*s)",
            uncertainty=leakage_of(scene, passage.uncertainty),
        ),
        area_fraction=Quantity(value=contact.area_fraction, unit="1", uncertainty=pixels["area_fraction"]),
        mean_gap=Quantity(value=contact.mean_gap, unit="m", uncertainty=pixels["mean_gap"]),
        sealed=passage.sealed,
        periods=periods(scene, contact.gap.size),
    )
