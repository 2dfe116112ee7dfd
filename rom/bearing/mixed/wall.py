"""The asperities of a bearing's rough wall, from what its scene says."""

from dataclasses import dataclass, field
from functools import lru_cache

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.asperity_contact import AsperityContact
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.roughness import RoughSurface, StoredTable
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.parts.solids import composite_modulus, hardness


def asperities_of(scene: Bearing, progress: Progress = silent) -> AsperityTable:
    """Flow factors and contact pressures of a scene's roughness: read from a table, or made, which takes a while.

    Raises
    ------
    InputError
        For a scene without asperities, or a table that knows nothing of them.
    ConvergenceError
        If a contact or a cell does not converge.
    """
    roughness, asperities = scene.roughness, scene.asperities
    if asperities is None or not isinstance(roughness, RoughSurface | StoredTable):
        raise InputError("scene.asperities: is missing; say of what the walls are that touch")
    if isinstance(roughness, StoredTable):
        try:
            return AsperityTable(factors=roughness.read())
        except InputError as error:
            raise InputError(f"scene.roughness.table: {str(error).removeprefix('table: ')}") from None
    told, solids = roughness.model_dump_json(exclude_none=True), asperities.model_dump_json(exclude_none=True)
    return _tabulated(_Order(roughness=told, asperities=solids, progress=progress))


@dataclass(frozen=True, kw_only=True)
class _Order:
    """A table to be made, by what it depends on."""

    roughness: str
    asperities: str
    progress: Progress = field(compare=False)


@lru_cache(maxsize=4)
def _tabulated(order: _Order) -> AsperityTable:
    from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed  # whose solvers are slow to import

    roughness = RoughSurface.model_validate_json(order.roughness)
    contact = AsperityContact.model_validate_json(order.asperities)
    assert contact.solid is not None
    return tabulate_pressed(
        roughness.scaled_heights(),
        roughness.scaled_spacing(),
        composite_modulus(contact.solid, contact.counter),
        hardness=hardness(contact.solid),
        progress=order.progress,
    )
