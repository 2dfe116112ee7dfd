"""All that the effects of one bearing do: at its film, under its load, and the inertia beside both."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from roughfilm.rom.bearing.effects.ablation import EFFECTS, Amount, Composition, at_film, effects_of
from roughfilm.rom.bearing.effects.contributions import Study, study
from roughfilm.rom.bearing.effects.explanation import Treatment, treatments
from roughfilm.rom.bearing.effects.inertia import InertiaAdded, inertia_added, judged, under_its_load
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Model, Progress, silent


@dataclass(frozen=True, kw_only=True)
class EffectAnalysis:
    """The contributions of the effects of a bearing.

    Attributes
    ----------
    treated : the model by which each effect is computed.
    at_film : contributions at the film of the scene.
    inertia : what inertia adds at that film; None where it cannot be judged.
    under_load : contributions under the load of the scene; None without a load.
    loaded_inertia : what inertia adds under that load.
    thicker : by how much inertia makes the film under that load thicker, m.
    """

    scene: Bearing
    treated: tuple[Treatment, ...]
    at_film: Study
    inertia: InertiaAdded | None
    under_load: Study | None = None
    loaded_inertia: InertiaAdded | None = None
    thicker: Amount | None = None

    @property
    def left_out(self) -> list[str]:
        """Names of the effects that the scene does not have."""
        present = effects_of(self.scene)
        return [effect.name for effect in EFFECTS if effect not in present]


def analyse_effects(scene: Bearing, cells: int, models: Sequence[Model], progress: Progress = silent) -> EffectAnalysis:
    """Switch the effects of a bearing on one at a time, at its film and, if it has one, under its load.

    Parameters
    ----------
    cells : along the sliding, and as many across.
    models : models of pockets, by which inertia is judged, among others.

    Raises
    ------
    InputError
        If the scene cannot be solved on such a grid.
    ConvergenceError
        If a film does not come into balance.
    """
    if scene.asperities is not None:
        asperities_of(scene, lambda done, words: progress(0.4 * done, f"asperities: {words}"))
    part = 0.6 if scene.load is None else 0.3
    at = study(
        scene,
        lambda taken, inner: at_film(taken, cells, inner),
        lambda done, words: progress(0.4 + part * done, words),
    )
    whole, heavy = Composition(scene=scene), judged(scene) is None
    analysis = EffectAnalysis(
        scene=scene,
        treated=treatments(scene),
        at_film=at,
        inertia=inertia_added(whole, cells, models) if heavy else None,
    )
    if scene.load is None:
        return analysis
    pressure = scene.load.pressure
    loaded = study(
        scene,
        lambda taken, inner: under_load(taken, pressure, cells, inner),
        lambda done, words: progress(0.7 + part * done, f"under load, {words}"),
    )
    there, thicker = under_its_load(whole, loaded.whole, pressure, cells, models) if heavy else (None, None)
    return replace(analysis, under_load=loaded, loaded_inertia=there, thicker=thicker)
