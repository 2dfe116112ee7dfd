"""The analysis of the effects of a bearing: at its film thickness, under its load, and by inertia."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from roughfilm.contact.foundation.brief import brief
from roughfilm.rom.bearing.effects.ablation import EFFECTS, Amount, Variant, VariantSolution, at_film, effects_of
from roughfilm.rom.bearing.effects.contributions import EffectStudy, study_effects
from roughfilm.rom.bearing.effects.explanation import EffectModel, effect_models
from roughfilm.rom.bearing.effects.free_wall import solved_freely
from roughfilm.rom.bearing.effects.heated import at_own_temperature, supplied, with_heat
from roughfilm.rom.bearing.effects.inertia import (
    FULL,
    InertiaAdded,
    inertia_added,
    inertia_obstacle,
    inertia_under_load,
)
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.equilibrium.expected import expected_film
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Model, Progress, silent


@dataclass(frozen=True, kw_only=True)
class EffectAnalysis:
    """The contributions of the effects of a bearing.

    Attributes
    ----------
    film : film thickness of the scene; if it is not given, that under the load, m.
    treated : the model of each effect.
    at_film : contributions at this film thickness.
    inertia : changes by inertia, and by slope, at that film thickness; None if they cannot be estimated.
    under_load : contributions under the load of the scene; None without a load.
    loaded_inertia : changes by inertia under that load; None if they cannot be estimated.
    thicker : increase of the film thickness under that load by inertia, m.
    """

    scene: Bearing
    film: float
    treated: tuple[EffectModel, ...]
    at_film: EffectStudy
    inertia: InertiaAdded | None
    under_load: EffectStudy | None = None
    loaded_inertia: InertiaAdded | None = None
    thicker: Amount | None = None

    __repr__ = brief

    @property
    def which_film(self) -> str:
        """The film of ``at_film`` in words: that of the scene or, if it gives none, that under the load."""
        return "at the film under the load" if self.scene.geometry.film is None else "at the film of the scene"

    @property
    def not_counted(self) -> dict[str, Mapping[str, Amount]]:
        """The changes of load and friction by effects that ``at_film`` does not include, by effect and quantity."""
        if self.inertia is None:
            return {}
        names = {f"{name}_per_width" if self.scene.wide else name: name for name in ("load", "friction")}
        changes = {"inertia": self.inertia.amounts, "slope": self.inertia.slope}
        return {
            effect: {name: one[key] for name, key in names.items()}
            for effect, one in changes.items()
            if one is not None
        }

    @property
    def left_out(self) -> list[str]:
        """Names of the effects that the scene does not have."""
        present = effects_of(self.scene)
        return [effect.name for effect in EFFECTS if effect not in present and not effect.kept(self.scene)]

    @property
    def not_switched(self) -> dict[str, str]:
        """The effects that the scene has, but that are not switched on and off, with the reasons."""
        return {effect.name: reason for effect in EFFECTS if (reason := effect.kept(self.scene))}


def analyse_effects(scene: Bearing, cells: int, models: Sequence[Model], progress: Progress = silent) -> EffectAnalysis:
    """Analyse the contributions of effects at the film thickness of a scene and, if it has one, under its load.

    Parameters
    ----------
    cells : number of cells along the sliding direction and across.
    models : models, among them those of pockets, which are used to estimate inertia.

    Raises
    ------
    InputError
        If the scene cannot be solved on such a grid.
    ConvergenceError
        If a film does not converge.
    """
    if scene.asperities is not None:
        asperities_of(scene, lambda done, words: progress(0.4 * done, f"asperities: {words}"))
    pressure, loaded = scene.load_pressure, None
    moves = isinstance(scene.geometry, MovingWall)
    if pressure is None:
        base = scene
    elif moves:
        base = scene.moved(scene.geometry)
    else:
        base = scene.at_film(scene.geometry.film or expected_film(scene).thickness)
    fraction = 0.6 if pressure is None else 0.3
    if pressure is not None:
        load = pressure
        loaded = study_effects(
            scene if moves else base,
            lambda variant, inner: with_heat(
                solved_freely if moves else partial(_carrying, load), variant, cells, inner
            ),
            lambda done, words: progress(0.4 + fraction * done, f"under load, {words}"),
        )
        if scene.geometry.film is None:
            base = supplied(loaded.whole.scene, scene)
    at = study_effects(
        base,
        lambda variant, inner: with_heat(solved_freely if moves else at_film, variant, cells, inner),
        lambda done, words: progress(1 - fraction + fraction * done, words),
    )
    whole, has_inertia = Variant(scene=at_own_temperature(base, at.whole)), inertia_obstacle(scene) is None
    inertia = inertia_added(whole, cells, models) if has_inertia else None
    analysis = EffectAnalysis(
        scene=scene,
        film=base.geometry.thinnest,
        treated=effect_models(scene, full=inertia is not None and inertia.model == FULL),
        at_film=at,
        inertia=inertia,
    )
    if pressure is None or loaded is None:
        return analysis
    if not has_inertia:
        return replace(analysis, under_load=loaded)
    hot = Variant(scene=at_own_temperature(base, loaded.whole))
    there, thicker = inertia_under_load(hot, loaded.whole, pressure, cells, models)
    return replace(analysis, under_load=loaded, loaded_inertia=there, thicker=thicker)


def _carrying(pressure: float, variant: Variant, cells: int, progress: Progress) -> VariantSolution:
    return under_load(variant, pressure, cells, progress)
