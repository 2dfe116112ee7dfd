"""Words and numbers of the leakage of a seal."""

from collections.abc import Iterable
from dataclasses import dataclass

from roughfilm.contact.mechanics.solid import beyond_elasticity, contact_outside
from roughfilm.rom.seal.at_load import SealAtLoad
from roughfilm.rom.seal.kind import leakage_outside
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.scatter import MEAN_SEALING_LOAD, SEALING_LOADS
from roughfilm.rom.seal.leakage.series import Row
from roughfilm.rom.seal.leakage.windows import SealingLoads
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.average import in_words as in_words_of
from roughfilm.words.numbers import share
from roughfilm.words.outside import outside_of_series
from roughfilm.words.scales import Scale, scale_for

WORDS = {
    "direct_x": "single period between reservoirs, x",
    "direct_y": "single period between reservoirs, y",
    "homogenized_x": "periodic, x",
    "homogenized_y": "periodic, y",
}


@dataclass(frozen=True, kw_only=True)
class UnderLoad:
    """A seal at one load: mean pressure, Pa, contact area fraction, largest pressure, Pa, and leakage, kg/(s m)."""

    load: float
    area_fraction: float
    peak: float
    leakage: float

    def outside(self, seal: Seal) -> tuple[str, ...]:
        """The sentences on contacts beyond linear elasticity, a leakage that is not laminar, and a gas."""
        contacts = contact_outside(self.load, self.area_fraction, seal.composite_modulus)
        return *contacts, *leakage_outside(seal, self.leakage)


def range_warnings(seal: Seal, series: Iterable[UnderLoad]) -> list[str]:
    """The warnings of loads outside the range of the model, and of those at which peaks alone exceed linear elasticity.

    A few tips beyond the limit hardly change the gap between them.
    """
    named = [(f"{one.load / 1e6:.4g} MPa", one) for one in series]
    beyond = outside_of_series([(place, one.outside(seal)) for place, one in named])
    peaks = [
        (place, () if one.outside(seal) else beyond_elasticity(one.peak, seal.composite_modulus))
        for place, one in named
    ]
    return [*filter(None, [beyond, outside_of_series(peaks, "; ".join)])]


def in_words(threshold: Threshold) -> str:
    """The load at which a direction seals, with the bracket of its contact area."""
    if threshold.sealed is None:
        return "does not seal"
    if threshold.open is None:
        return "sealed at every load"
    low, high = 100 * threshold.open.area_fraction, 100 * threshold.sealed.area_fraction
    return f"seals at {threshold.load / 1e6:.4g} MPa, {low:.2f} to {high:.2f} % contact"


def scatter_in_words(spread: float) -> str:
    """The sealing loads of other surfaces without a lay of the same E* g', Pa, as a sentence."""
    low, high = SEALING_LOADS["without a lay"]
    return (
        f"other surfaces of this rms slope seal at {MEAN_SEALING_LOAD * spread / 1e6:.3g} MPa on average, 95 of 100 "
        f"directions at {low * spread / 1e6:.3g} to {high * spread / 1e6:.3g} MPa, if they have no lay"
    )


def leakage_scale(answer: SealAtLoad) -> Scale:
    """The unit of all leakages of a page, from that of the seal at its load."""
    return scale_for(answer.leakage_per_width.unit, answer.leakage_per_width.value)


def leaks(scene: Seal, row: Row, name: str, scale: Scale) -> str:
    """The leakage per width of a row with its uncertainty, or "sealed"."""
    value, uncertainty = (leakage_of(scene, getattr(row, key)) for key in (name, f"{name}_uncertainty"))
    return "sealed" if getattr(row, f"{name}_sealed") else scale.number(value, uncertainty)


def answer_in_words(scene: Seal, answer: SealAtLoad) -> str:
    """What a seal leaks at one load, as a part of a sentence."""
    where = f"along {scene.flow.direction} at {answer.load / 1e6:.4g} MPa"
    if answer.sealed:
        return f"{where}: sealed"
    one = answer.leakage_per_width
    return f"{where}: {leakage_scale(answer).text(one.value, one.uncertainty)}"


def sealing_in_words(sealing: SealingLoads) -> str:
    """The loads at which windows seal in a direction, as a part of a sentence."""
    if sealing.sealing == 0:
        return "no window seals"
    if sealing.load is None:
        return f"{share(sealing.sealing)} of the windows seal"
    if sealing.always == 1:
        return "every window is sealed at every load"
    always = f", {share(sealing.always)} of them at every load" if sealing.always else ""
    megapascal = Scale(factor=1e6, unit="MPa")
    return f"windows seal at {in_words_of(sealing.load, megapascal)}{always}"
