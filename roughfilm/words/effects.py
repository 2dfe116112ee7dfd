"""Quantities, numbers and sentences of the effects of a bearing."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from roughfilm.rom.bearing.effects.ablation import Amount
from roughfilm.rom.bearing.effects.contributions import EffectStudy
from roughfilm.words.numbers import percent, with_error

NOTHING = 1e-9
"""In the units of the tables: rounding."""


@dataclass(frozen=True, kw_only=True)
class Shown:
    """A quantity of the tables: its name in words, its unit there, and how many of it are one of SI."""

    title: str
    unit: str
    factor: float = 1.0


SHOWN: Mapping[str, Shown] = {
    "film": Shown(title="film thickness", unit="µm", factor=1e6),
    "load": Shown(title="load", unit="N"),
    "load_per_width": Shown(title="load", unit="N/m"),
    "friction": Shown(title="friction", unit="N"),
    "friction_per_width": Shown(title="friction", unit="N/m"),
    "friction_coefficient": Shown(title="friction coefficient", unit="10⁻³", factor=1e3),
    "inlet_flow_per_width": Shown(title="inlet flow", unit="mm²/s", factor=1e6),
    "side_leakage": Shown(title="side leakage", unit="mm³/s", factor=1e9),
    "contact_share": Shown(title="carried by contact", unit="%", factor=100),
}
AT_FILM = ("load", "friction", "inlet_flow_per_width", "side_leakage")
UNDER_LOAD = ("film", "friction_coefficient", "inlet_flow_per_width", "side_leakage")


def shown(told: EffectStudy, names: Sequence[str]) -> dict[str, Shown]:
    """Those of the quantities that a study tells, by width where there is none of the whole."""
    names = [name if name in told.full else f"{name}_per_width" for name in names]
    return {name: SHOWN[name] for name in names if name in told.full and name in SHOWN}


def cell(one: Amount | None, how: Shown, *, sign: bool = False) -> str:
    """A number with its error in the unit of its table; with its sign where it is added to another."""
    if one is None:
        return "–"
    if max(abs(one.value), one.uncertainty) * how.factor < NOTHING:
        return "0"
    told = with_error(how.factor * one.value, how.factor * one.uncertainty)
    return f"+{told}" if sign and one.value > 0 and not told.startswith("(") else told.replace("-", "−")


def sentences(study_told: EffectStudy, name: str, inertia: Amount | None) -> list[str]:
    """What each effect adds to one quantity, in words, as parts of all of it."""
    how, full = SHOWN[name], study_told.full[name]
    told = []
    for one in study_told.contributions:
        on, alone = one.on.get(name), one.alone.get(name)
        if on is None and alone is None:
            continue
        parts = [_adds(on, how, full.value)] if on else []
        parts += [f"to all the others {_adds(alone, how, full.value)}"] if alone else []
        told.append(f"{one.name}: {', '.join(parts)}")
    if inertia is not None:
        told.append(f"inertia, not counted above: {_adds(inertia, how, full.value)}")
    return told


def _adds(one: Amount, how: Shown, full: float) -> str:
    part = f" ({percent(one.value / abs(full))})".replace("-", "−") if full else ""
    return f"{cell(one, how, sign=True)} {how.unit}{part}"
