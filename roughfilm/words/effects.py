"""Quantities, numbers and sentences of the effects of a bearing."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from roughfilm.rom.bearing.effects.ablation import Amount
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.words.numbers import percent, with_error
from roughfilm.words.scales import scale_for

ROUNDING = 1e-7
"""Numbers below this, in the units of the tables, are written as 0."""

NEGLIGIBLE = 1e-7
"""Numbers below this part of the value with all effects are written as 0."""

MAX_CHANGE = 10.0
"""Change over the whole up to which it is given in per cent; a whole near zero is no measure."""


@dataclass(frozen=True, kw_only=True)
class Shown:
    """A quantity of the tables.

    Attributes
    ----------
    title, unit : its title and its unit there.
    factor : factor from the SI unit.
    negligible : magnitude in the SI unit below which a number is written as 0.
    """

    title: str
    unit: str
    factor: float = 1.0
    negligible: float = 0.0


SHOWN: Mapping[str, Shown] = {
    "film": Shown(title="film thickness", unit="µm", factor=1e6),
    "load": Shown(title="load", unit="N"),
    "load_per_width": Shown(title="load", unit="N/m"),
    "friction": Shown(title="friction", unit="N"),
    "friction_per_width": Shown(title="friction", unit="N/m"),
    "friction_coefficient": Shown(title="friction coefficient", unit="10⁻³", factor=1e3),
    "inlet_flow_per_width": Shown(title="inlet flow per width", unit="mm²/s", factor=1e6),
    "side_leakage": Shown(title="side leakage", unit="ml/min", factor=60e6),
    "effective_temperature": Shown(title="temperature", unit="°C"),
    "contact_share": Shown(title="carried by contact", unit="%", factor=100),
}
FORCES = ("load", "load_per_width", "friction", "friction_per_width")
"""The quantities whose unit follows from their size; the others have the same on every page."""

AT_FILM = ("load", "friction", "inlet_flow_per_width", "side_leakage", "effective_temperature")
UNDER_LOAD = ("film", "friction_coefficient", "inlet_flow_per_width", "side_leakage", "effective_temperature")


def shown_quantities(study: EffectStudy, names: Sequence[str]) -> dict[str, Shown]:
    """The quantities of these names that a study has, each per width where there is none of the whole bearing."""
    names = [name if name in study.full else f"{name}_per_width" for name in names]
    return {name: _in_its_unit(name, study.full[name]) for name in names if name in study.full and name in SHOWN}


def _in_its_unit(name: str, full: Amount) -> Shown:
    how = replace(SHOWN[name], negligible=NEGLIGIBLE * abs(full.value))
    if name not in FORCES:
        return how
    scale = scale_for(how.unit, abs(full.value))
    return replace(how, unit=scale.unit, factor=1 / scale.factor)


def cell(amount: Amount | None, how: Shown, *, sign: bool = False) -> str:
    """A number with its uncertainty in the unit of its table; with its sign where it is added to another."""
    if amount is None:
        return "–"
    if max(abs(amount.value), amount.uncertainty) < max(ROUNDING / how.factor, how.negligible):
        return "0"
    text = with_error(how.factor * amount.value, how.factor * amount.uncertainty)
    zero = not text.partition(" ")[0].strip("-0.")
    signed = sign and amount.value > 0 and not zero and not text.startswith("(")
    return f"{'+' if signed else ''}{text}".replace("-", "−")


def sentences(study: EffectStudy, name: str, not_counted: Mapping[str, Mapping[str, Amount]]) -> list[str]:
    """What each effect adds to one quantity, with its fraction of the whole, as sentences.

    Parameters
    ----------
    not_counted : changes by effects that the study does not include, by effect and quantity.
    """
    full = study.full[name]
    how, lines = _in_its_unit(name, full), []
    for one in study.contributions:
        on, alone = one.on.get(name), one.alone.get(name)
        parts = [_adds(on, how, full.value)] if on else []
        parts += [f"to all the others {_adds(alone, how, full.value)}"] if alone else []
        if parts:
            lines.append(f"{one.name}: {', '.join(parts)}")
    for effect, amounts in not_counted.items():
        lines.append(f"{effect}, not counted above: {_adds(amounts[name], how, full.value)}")
    return lines


def _adds(amount: Amount, how: Shown, full: float) -> str:
    part = of_whole(amount, full)
    return f"{cell(amount, how, sign=True)} {how.unit}{f' ({part})' if part else ''}"


def of_whole(amount: Amount, full: float) -> str:
    """A contribution over the whole, in per cent; empty where the whole is near zero."""
    comparable = full and abs(amount.value) <= MAX_CHANGE * abs(full)
    return percent(amount.value / abs(full)) if comparable else ""
