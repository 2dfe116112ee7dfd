"""Stiffness, damping and stability of bearings in words."""

import math

from roughfilm.contact.foundation.rounding import with_error
from roughfilm.rom.bearing.dynamics.point import DynamicPoint
from roughfilm.rom.bearing.dynamics.sweep import DynamicCurve
from roughfilm.rom.bearing.dynamics.whirl import SAME
from roughfilm.rom.bearing.free.film import refilled
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.words.numbers import digits
from roughfilm.words.outside import outside_in_words, outside_of_series
from roughfilm.words.stribeck import SpeedScale, speed_scale

STABLE, UNSTABLE = "any", "none"
"""Critical mass of a rotor that is stable at any mass, or at none."""


FAST = 2.0
"""Frequency over the speed up to which a dependence of stiffness and damping on it is said."""


def number_of(point: DynamicPoint, name: str, factor: float = 1.0) -> str:
    """A number of a point times a factor, with its uncertainty, which may be unknown."""
    text = with_error(factor * point.numbers[name], factor * point.uncertainty.get(name, math.inf))
    return text.replace("-", "−")


def critical_mass(point: DynamicPoint) -> str:
    """The largest mass, kg, with its uncertainty, at which a rigid rotor is stable; or "any" or "none"."""
    value = point.numbers["critical_mass"]
    if not value or math.isinf(value):
        return STABLE if value else UNSTABLE
    return number_of(point, "critical_mass")


def whirl_ratio(point: DynamicPoint) -> str:
    """The whirl ratio with its uncertainty; "none" without whirl."""
    value = point.numbers["whirl_ratio"]
    return number_of(point, "whirl_ratio") if value > 0 else "none"


def onset(scene: Bearing, curve: DynamicCurve) -> str:
    """The speed at which a rotor of the scene's mass becomes unstable, in words; "" without a mass."""
    if curve.onset is None:
        return ""
    scale, rotor = speed_scale(scene), f"a rotor of {curve.onset.mass:.4g} kg"
    if math.isnan(curve.onset.rotation):
        return f"{rotor} is unstable at all these speeds, from {_lowest(curve, scale)} on"
    if math.isinf(curve.onset.rotation):
        return f"{rotor} is stable at all these speeds"
    factor = 60 / (2 * math.pi)
    speed = with_error(factor * curve.onset.rotation, factor * curve.onset.uncertainty)
    return f"{rotor} becomes unstable at {speed} rpm"


def _lowest(curve: DynamicCurve, scale: SpeedScale) -> str:
    return f"{digits(scale.factor * curve.points[0].speed)} {scale.unit}"


def own_point(scene: Bearing, curve: DynamicCurve) -> DynamicPoint:
    """The point of a curve whose speed is nearest to that of the scene."""
    own = abs(scene.motion.speed)
    return min(curve.points, key=lambda point: abs(point.speed - own))


def answer_of(scene: Bearing, curve: DynamicCurve) -> str:
    """Stiffness, damping and stability of a curve at the speed nearest to that of the scene."""
    point, scale = own_point(scene, curve), speed_scale(scene)
    beyond = outside_in_words(point.outside)
    at = f"at {digits(scale.factor * point.speed)} {scale.unit} under {curve.pressure / 1e6:.4g} MPa"
    if point.numbers.get("contact_share"):
        at += f", of which asperities carry {number_of(point, 'contact_share', 100.0)} %"
    if "temperature" in point.numbers:
        at += f", film at {number_of(point, 'temperature')} °C"
    if "whirl_ratio" not in point.numbers:
        words = (
            f"stiffness {number_of(point, 'stiffness', 1e-6)} N/µm, damping {number_of(point, 'damping')} N·s/m {at}"
        )
        return "; ".join(filter(None, [beyond, words]))
    mass = critical_mass(point)
    if mass in (STABLE, UNSTABLE):
        words = f"a rigid rotor is stable at {'any' if mass == STABLE else 'no'} mass {at}"
    elif point.uncertainty.get("critical_mass", math.inf) >= point.numbers["critical_mass"]:
        words = f"the critical mass of a rigid rotor is unknown on this grid {at}, take more cells"
    else:
        words = f"a rigid rotor is stable up to {mass} kg in the bearing, whirl ratio {whirl_ratio(point)}, {at}"
    return "; ".join(filter(None, [beyond, words, onset(scene, curve), slow_up_to(point)]))


def slow_up_to(point: DynamicPoint) -> str:
    """From which frequency on stiffness and damping differ from those of slow motions, in words; "" up to ``FAST``."""
    ratio = point.numbers.get("slow_ratio", FAST)
    if ratio >= FAST:
        return ""
    return (
        f"stiffness and damping differ by more than {SAME:.0%} from those of slow motions above "
        f"{number_of(point, 'slow_ratio')} of the speed"
    ).replace("%", " %")


def warnings_of(scene: Bearing, curve: DynamicCurve) -> list[str]:
    """Warnings about films outside the range of the model, speeds without an equilibrium, and unstable rotors."""
    scale, warnings, load = speed_scale(scene), [], f"{curve.pressure / 1e6:.4g} MPa"
    places = [(f"{digits(scale.factor * one.speed)} {scale.unit}", one.outside) for one in curve.points]
    if beyond := outside_of_series(places):
        warnings.append(f"{load}: {beyond}")
    if curve.omitted:
        speeds = ", ".join(digits(scale.factor * one.speed) for one in curve.omitted)
        warnings.append(f"{load}: left out at {speeds} {scale.unit}: {curve.omitted[0].reason}")
    if refilled(scene):
        warnings.append(
            "the sides of the bore are at the cavitation pressure, and nothing else supplies it: oil around it is "
            "taken to fill its cavities at once; give [[supply]] for a bore in air"
        )
    unstable = [point for point in curve.points if point.numbers.get("critical_mass") == 0]
    if unstable:
        warnings.append(
            f"{load}: at {len(unstable)} of {len(curve.points)} speeds a rotor is stable at no mass: even without mass "
            "its motion grows, as the film takes more energy from the rotation than it dissipates at some frequency, "
            "or in a film without a cavity as much"
        )
    return warnings
