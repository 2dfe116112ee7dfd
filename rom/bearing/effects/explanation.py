"""By which model each effect of a composed bearing is told, and why: in words, with the numbers that say so."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from roughfilm.rom.bearing.effects.ablation import effects_of
from roughfilm.rom.bearing.effects.inertia import judged
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.scene import Bearing

Numbers = Mapping[str, float]

HEAVY, LONG = 0.3, 0.1
"""Re·h/l from which inertia is not small; period over length from which averaging is off by more than some per cent."""


@dataclass(frozen=True, kw_only=True)
class Treatment:
    """An effect, the model that tells it, and why that one."""

    effect: str
    model: str
    why: str


def treatments(scene: Bearing) -> tuple[Treatment, ...]:
    """One for each effect that a scene has, then that of inertia; those that it lacks are left out."""
    numbers = bearing_numbers(scene)
    told = [
        Treatment(effect=effect.name, model=model, why=why(numbers))
        for effect in effects_of(scene)
        for model, why in [TOLD[effect.name]]
    ]
    refused = judged(scene)
    why = _inertia(numbers) if refused is None else f"left out: {refused}"
    return (
        *told,
        Treatment(effect="inertia", model="first order, beside the film" if not refused else "none", why=why),
    )


def _sides(numbers: Numbers) -> str:
    return f"the film is solved over its plane, since width over length = {numbers['slenderness']:.2g}"


def _texture(numbers: Numbers) -> str:
    covered = (
        f"pockets over {numbers['texture_density']:.0%} of the area, {numbers['pocket_depth_ratio']:.2g} films deep, "
        "are resolved as thin film"
    )
    if "reduced_reynolds_number" not in numbers:
        return covered
    number = numbers["reduced_reynolds_number"]
    return f"{covered}, since Re·h/l = {number:.2g}: " + (
        "inertia is small, and told apart" if number < HEAVY else "inertia is not small, look at its row"
    )


def _cavitation(numbers: Numbers) -> str:
    number = numbers["cavitation_number"]
    bears = "it bears little of what sliding pulls" if number < 1 else "it hardly ever tears"
    starved = "; without it the starved inlet counts as full" if numbers.get("starvation", 1.0) < 1 else ""
    return f"mass is kept where the film tears, since (p_ambient − p_c)/(6ηuL/h²) = {number:.2g}: {bears}{starved}"


def _pressure(numbers: Numbers) -> str:
    return (
        "density and viscosity follow pressure: at 6ηuL/h², of which a pad carries some hundredths, "
        f"θ − 1 = {numbers['compression']:.2g} and ln η/η₀ = {numbers['piezoviscous']:.2g}"
    )


def _roughness(numbers: Numbers) -> str:
    told = f"Sq/h = {numbers['roughness_ratio']:.2g}"
    if "roughness_period" not in numbers:
        return f"by the flow factors of its table, {told}"
    period = numbers["roughness_period"]
    return f"by its flow factors, since period over length = {period:.2g}, {told}" + (
        "" if period < LONG else "; so long waves are worth following by the rung direct"
    )


def _asperities(numbers: Numbers) -> str:
    ratio = numbers["peak_ratio"]
    return f"by the table of contact pressures, since λ = h/Sq = {1 / numbers['roughness_ratio']:.2g} and " + (
        f"Sp/h = {ratio:.2g}: the highest tips {'touch' if ratio > 1 else 'do not touch'}"
    )


def _inertia(numbers: Numbers) -> str:
    pocket = ", and in full in one pocket" if "pocket_depth_ratio" in numbers else ""
    return (
        f"Re = {numbers['reynolds_number']:.2g}, Re·h/l = {numbers['reduced_reynolds_number']:.2g}: to first order "
        f"over the whole film{pocket}; not added to what the film carries"
    )


TOLD: Mapping[str, tuple[str, Callable[[Numbers], str]]] = {
    "side flow": ("reynolds", _sides),
    "texture": ("reynolds", _texture),
    "cavitation": ("reynolds_incompressible", _cavitation),
    "pressure dependence": ("reynolds_cavitating", _pressure),
    "roughness": ("homogenized", _roughness),
    "asperities": ("mixed", _asperities),
}
