"""The isothermal model that a scene needs: smooth walls, averaged roughness, or asperities that touch."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.film import averaged_film, averaged_films
from roughfilm.rom.bearing.quantities import FILM_OUTPUTS, Outputs
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.problem import Problem

MIXED_OUTPUTS = Outputs(
    quantities=deferred("rom.bearing.mixed.quantities", "contact_quantities"),
    factor_uncertainties=deferred("rom.bearing.mixed.quantities", "mixed_uncertainties"),
    fields=deferred("rom.bearing.mixed.quantities", "mixed_fields"),
    warnings=deferred("rom.bearing.mixed.quantities", "mixed_warnings"),
    of_finest=deferred("rom.bearing.mixed.quantities", "flash_quantities"),
)


@dataclass(frozen=True, kw_only=True)
class IsothermalModel:
    """The options of :func:`roughfilm.rom.bearing.solve.solve` for an isothermal film.

    Attributes
    ----------
    film : film(scene), the problem of the film.
    outputs : the functions that evaluate it.
    more : further options of the solver, by name.
    """

    film: Callable[[Bearing], Problem]
    outputs: Outputs = FILM_OUTPUTS
    more: dict[str, Any] = field(default_factory=dict)


SMOOTH = IsothermalModel(film=Bearing.problem)
AVERAGED = IsothermalModel(film=averaged_film, more={"searched": averaged_films})
MIXED = IsothermalModel(
    film=deferred("rom.bearing.mixed.quantities", "film_of_scene"),
    outputs=MIXED_OUTPUTS,
    more={
        "searched": deferred("rom.bearing.mixed.quantities", "searched_films"),
        "films": deferred("rom.bearing.mixed.quantities", "mixed_films"),
        "contact": deferred("rom.bearing.mixed.wall", "asperities_of"),
    },
)


def isothermal_model(scene: Bearing) -> IsothermalModel:
    """The isothermal model with asperities that touch, averaged roughness or smooth walls, as the scene has them."""
    if scene.asperities is not None:
        return MIXED
    return SMOOTH if scene.roughness is None else AVERAGED
