"""Words and numbers of the leakage of a seal."""

from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.series import Row
from roughfilm.rom.seal.model import leakage_of
from roughfilm.rom.seal.scene import Seal

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


def leaks(scene: Seal, row: Row, name: str) -> str:
    """Leakage per metre of width, kg/h, or "sealed"."""
    return "sealed" if getattr(row, f"{name}_sealed") else f"{3600 * leakage_of(scene, getattr(row, name)):.3g}"
