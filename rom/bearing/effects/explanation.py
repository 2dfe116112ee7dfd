"""The model of each effect of a bearing and the reason, with the dimensionless numbers."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from roughfilm.rom.bearing.effects.ablation import effects_of
from roughfilm.rom.bearing.effects.inertia import FIRST_ORDER, FULL, inertia_obstacle
from roughfilm.rom.bearing.effects.viscosity import viscosity_omitted
from roughfilm.rom.bearing.effects.wide_pad import wide_pad
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.models.heat_balance import MODEL as HEAT_BALANCE
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import kind_of_scene

Numbers = Mapping[str, float]

SMALL_REDUCED_REYNOLDS_NUMBER = 0.3
"""Reduced Reynolds number Re·h/l below which inertia is small."""

HEATING = "heating"
"""The effect whose reason depends on the lubricant too."""

SLOPE = "to second order, film_slope minus film; not included in the load of the film"
"""The reason for the model of slope."""

CONDUCTION = (
    (1.0, "reaches across"),
    (10.0, "reaches a part of the way across"),
    (math.inf, "hardly reaches into"),
)
"""How far heat is conducted into the film while it passes, below a Péclet number."""

SMALL_PERIOD_RATIO = 0.1
"""Period of the roughness over the length below which the error of averaging is a few per cent."""


@dataclass(frozen=True, kw_only=True)
class EffectModel:
    """An effect, its model, and the reason for that model."""

    effect: str
    model: str
    why: str


def effect_models(scene: Bearing, *, full: bool | None = None) -> tuple[EffectModel, ...]:
    """The models of the effects that a scene has, of inertia, and of slope where it is resolved.

    Parameters
    ----------
    full : whether inertia is computed in full; by default as at the expected film.
    """
    numbers = bearing_numbers(scene)
    models = [
        EffectModel(effect=effect.name, model=model, why=why(numbers))
        for effect in effects_of(scene)
        if effect.name != HEATING
        for model, why in [EFFECT_MODELS[effect.name]]
    ]
    if (heating := heating_words(scene)) is not None:
        models.append(EffectModel(effect=HEATING, model=HEAT_BALANCE.name, why=f"{heating}{_uneven(scene)}"))
    obstacle = inertia_obstacle(scene)
    if obstacle is not None:
        return (*models, EffectModel(effect="inertia", model="none", why=f"left out: {obstacle}"))
    if full is None:
        pad = wide_pad(expected_scene(scene))
        full = pad is not None and not pad.ruptures
    if not full:
        model = f"{FIRST_ORDER}, separate from the film"
        return (*models, EffectModel(effect="inertia", model=model, why=_inertia(numbers)))
    return (
        *models,
        EffectModel(effect="inertia", model=FULL, why=_full_inertia(numbers)),
        EffectModel(effect="slope", model="film_slope", why=SLOPE),
    )


def heating_words(scene: Bearing) -> str | None:
    """What friction does to the temperature of the film, by its numbers; None of a scene without temperature.

    Without heat to the walls the lubricant of the viscosity η exp(-β T) is heated by ln(1 + N)/β with the heating
    number N; between walls at its temperature by ln(1 + Na/8)/β at most, with the Nahme number Na.
    """
    numbers = bearing_numbers(scene)
    if "heating_number" not in numbers:
        return None
    liquid = scene.lubricant.liquid
    viscosity, slope = (float(one[0]) for one in liquid.viscosity(np.array([liquid.temperature])))
    coefficient, heating = -slope / viscosity, numbers["heating_number"]
    if coefficient <= 0 or heating == 0:
        return "friction does not change the viscosity"
    words = (
        f"friction heats the film by about {math.log1p(heating) / coefficient:.2g} K while it passes, if the "
        f"walls take no heat, and its viscosity falls by {100 * heating / (1 + heating):.0f} %"
    )
    if "thermal_peclet_number" not in numbers:
        return words
    peclet = numbers["thermal_peclet_number"]
    reaches = next(reach for below, reach in CONDUCTION if peclet < below)
    walls = math.log1p(numbers["nahme_number"] / 8) / coefficient
    return (
        f"{words}; conduction {reaches} it (Péclet number {peclet:.2g}), and walls at the temperature of the supplied "
        f"lubricant would leave {walls:.2g} K at most"
    )


def _sides(numbers: Numbers) -> str:
    return f"the film is solved in two dimensions: width over length = {numbers['slenderness']:.2g}"


def _texture(numbers: Numbers) -> str:
    resolved = (
        f"pockets over {100 * numbers['texture_density']:.0f} % of the area, "
        f"{numbers['pocket_depth_ratio']:.2g} times h deep, are resolved as a thin film"
    )
    if "reduced_reynolds_number" not in numbers:
        return resolved
    number = numbers["reduced_reynolds_number"]
    size = "small" if number < SMALL_REDUCED_REYNOLDS_NUMBER else "not small"
    return f"{resolved}; reduced Reynolds number Re·h/l = {number:.2g}: inertia is {size} and estimated separately"


def _cavitation(numbers: Numbers) -> str:
    number = numbers["cavitation_number"]
    expected = "expected" if number < 1 else "unlikely"
    starved = (
        "; without cavitation the starved inlet is treated as flooded" if numbers.get("starvation", 1.0) < 1 else ""
    )
    reserve = f"ambient minus cavitation pressure over 6ηuL/h² = {number:.2g}"
    return f"mass-conserving; {reserve}: cavitation is {expected}{starved}"


def _pressure(numbers: Numbers) -> str:
    return (
        "density and viscosity depend on pressure: at 6ηuL/h² (pads carry a few per cent of it) "
        f"compression θ − 1 = {numbers['compression']:.2g} and viscosity ln η/η₀ = {numbers['piezoviscous']:.2g}"
    )


def _roughness(numbers: Numbers) -> str:
    height = f"rms height over film Sq/h = {numbers['roughness_ratio']:.2g}"
    if "roughness_period" not in numbers:
        return f"flow factors of its table, {height}"
    period = numbers["roughness_period"]
    remedy = "" if period < SMALL_PERIOD_RATIO else "; resolve such long waves with the model direct"
    return f"flow factors: period over length = {period:.2g}, {height}{remedy}"


def _asperities(numbers: Numbers) -> str:
    ratio = numbers["peak_ratio"]
    return f"table of contact pressures: film over rms height λ = h/Sq = {1 / numbers['roughness_ratio']:.2g}, " + (
        f"highest peak over film Sp/h = {ratio:.2g}: the highest tips {'touch' if ratio > 1 else 'do not touch'}"
    )


def _reynolds_numbers(numbers: Numbers) -> str:
    return (
        f"Reynolds number Re = {numbers['reynolds_number']:.2g}, reduced one Re·h/l = "
        f"{numbers['reduced_reynolds_number']:.2g}"
    )


def _full_inertia(numbers: Numbers) -> str:
    return (
        f"{_reynolds_numbers(numbers)}: in full, film minus the same film without density; "
        "not included in the load of the film"
    )


def _inertia(numbers: Numbers) -> str:
    pocket = ", and fully in one pocket" if "pocket_depth_ratio" in numbers else ""
    return (
        f"{_reynolds_numbers(numbers)}: to first order over the whole film{pocket}; "
        "not included in the load of the film"
    )


def _shear_thinning(numbers: Numbers) -> str:  # noqa: ARG001
    return "viscosities across the film by the law of the lubricant, exact for a straight gap"


def _uneven(scene: Bearing) -> str:
    """What the temperature over the film and across it changes, which one temperature leaves out."""
    left_out = viscosity_omitted(scene, HEAT_BALANCE, next(iter(kind_of_scene(scene).compared)))
    return "; one temperature for the whole film" + ("" if left_out is None else f"; not counted: {left_out.reason}")


EFFECT_MODELS: Mapping[str, tuple[str, Callable[[Numbers], str]]] = {
    "side flow": ("reynolds", _sides),
    "texture": ("reynolds", _texture),
    "cavitation": ("reynolds_incompressible", _cavitation),
    "pressure dependence": ("reynolds_cavitating", _pressure),
    "roughness": ("homogenized", _roughness),
    "asperities": ("mixed", _asperities),
    "shear thinning": ("shear_thinning", _shear_thinning),
}
"""The model of each effect but heating by the name of the effect, and the function that gives the reason."""
