"""The asperities of the rough wall of a scene."""

from dataclasses import dataclass, field
from functools import lru_cache

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.asperity_contact import AsperityContact
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.roughness import RoughSurface, StoredTable
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Progress, report
from roughfilm.rom.parts.solids import composite_modulus, hardness


def asperities_of(scene: Bearing, progress: Progress = report) -> AsperityTable:
    """The flow factors and contact pressures of a scene's roughness, from a stored table or computed.

    Raises
    ------
    InputError
        If the scene has no asperities, or its table has no contact pressures.
    ConvergenceError
        If a contact or a cell does not converge.
    """
    roughness, asperities = scene.roughness, scene.asperities
    if asperities is None or not isinstance(roughness, RoughSurface | StoredTable):
        raise InputError("scene.asperities: is missing; give the solids of the walls")
    if isinstance(roughness, StoredTable):
        try:
            return AsperityTable(factors=roughness.read())
        except InputError as error:
            raise InputError(f"scene.roughness.table: {str(error).removeprefix('table: ')}") from None
    entries, solids = roughness.model_dump_json(exclude_none=True), asperities.model_dump_json(exclude_none=True)
    return _tabulated(_TableInput(roughness=entries, asperities=solids, progress=progress))


@dataclass(frozen=True, kw_only=True)
class _TableInput:
    """The input of a table; the progress does not count in comparisons."""

    roughness: str
    asperities: str
    progress: Progress = field(compare=False)


@lru_cache(maxsize=4)
def _tabulated(order: _TableInput) -> AsperityTable:
    from roughfilm.rom.bearing.mixed.kept import kept_asperities  # whose solvers are slow to import

    roughness = RoughSurface.model_validate_json(order.roughness)
    contact = AsperityContact.model_validate_json(order.asperities)
    assert contact.solid is not None
    heights, spacing = roughness.scaled_heights(), roughness.scaled_spacing()
    stiffness, bound = composite_modulus(contact.solid, contact.counter), hardness(contact.solid)
    return kept_asperities(heights, spacing, stiffness, bound, surface=roughness.name, progress=order.progress)
