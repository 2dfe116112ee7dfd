"""Words and numbers of the leakage of a seal."""

from roughfilm.rom.seal.at_load import SealAtLoad
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.scatter import MEAN_SEALING_LOAD, SEALING_LOADS
from roughfilm.rom.seal.leakage.series import Row
from roughfilm.rom.seal.leakage.windows import SealingLoads
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.average import in_words as in_words_of
from roughfilm.words.numbers import share
from roughfilm.words.scales import Scale, scale_for

WORDS = {
    "direct_x": "single period between reservoirs, x",
    "direct_y": "single period between reservoirs, y",
    "homogenized_x": "periodic, x",
    "homogenized_y": "periodic, y",
}


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
