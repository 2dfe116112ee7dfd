"""The solver of the models with temperatures over the film."""

from collections.abc import Callable

from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import solve
from roughfilm.rom.bearing.thermal.field.coupling import Heating
from roughfilm.rom.bearing.thermal.field.films import HeatedBearing
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm
from roughfilm.rom.bearing.thermal.field.quantities import HeatedOutputs
from roughfilm.rom.bearing.thermal.isothermal import isothermal_model
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Result


def solve_heated(
    solver: Model[Bearing],
    scene: Bearing,
    request: CheckedRequest,
    progress: Progress,
    *,
    heating: Callable[[Bearing], Heating[HeatedFilm]],
) -> Result:
    """Solve the film of a bearing and its temperatures, and estimate the uncertainty of its quantities.

    The film is that of the isothermal model that the scene needs, whose viscosities at the nodes are those of the
    temperatures of its own flows (:func:`roughfilm.rom.bearing.thermal.field.coupling.coupled`). Each grid has its own
    temperatures, and starts from those of the coarser one; under a load each film of the search has.

    Parameters
    ----------
    solver : the model.
    heating : heating(scene), the energy equation of its films.

    Raises
    ------
    InputError
        If no film carries the load of the scene.
    ConvergenceError
        If the film, its load or its temperatures do not converge, or the temperatures run away.
    """
    base, equation = isothermal_model(scene), heating(scene)
    return solve(
        solver,
        scene,
        request,
        progress,
        film=base.film,
        ruptures=True,
        outputs=HeatedOutputs(base.outputs, equation).outputs,
        heat=HeatedBearing(heating=equation),
        **base.more,
    )
