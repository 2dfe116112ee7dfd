"""The viscosity of a liquid in scene files, dynamic or kinematic."""

from typing import Any

from pydantic import model_validator

from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.foundation.units import dynamic_viscosity


class Fluid(Part):
    """A table of a scene with ``viscosity`` and ``density``, where a kinematic viscosity counts with the density."""

    @model_validator(mode="before")
    @classmethod
    def _takes_a_kinematic_viscosity(cls, entries: Any) -> Any:
        if not isinstance(entries, dict) or "viscosity" not in entries:
            return entries
        return {**entries, "viscosity": dynamic_viscosity(entries["viscosity"], entries.get("density"))}
