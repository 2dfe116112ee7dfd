"""How far a model may be trusted on a scene: the number that orders its errors, and up to where it kept a tolerance."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from roughfilm.rom.ladder.model import Applicability
from roughfilm.rom.pocket.scene import Pocket

SYMBOLS = {"reynolds_number": "Re", "depth": "d/Ly", "aspect": "2d/w", "slope": "slope"}
"""``slope`` is that of the steeper side of a groove, 2d/w if its lowest point is in the middle."""

NARROWEST, DEEPEST = 5.0, 0.5
"""w/Ly and 2d/w: grooves that are narrower, or deeper for their width, were not among those of the sweep."""


@dataclass(frozen=True, kw_only=True)
class ErrorLaw:
    """Error in load of a model, ordered by a product of powers of Re, d/Ly, 2d/w and slope of a scene.

    ``thresholds`` gives for each tolerance the number up to which 95 of 100 cases of a sweep kept it, against the best
    rung: grooves of w/Lx = 0.15 to 0.5, d/Ly = 0.25 to 1.25, cylindrical and splined, Re = 40 to 160, Ly/Lx = 0.03
    (scripts/examples/studies/paper_a.toml, judged by ``roughfilm report``).
    """

    powers: Mapping[str, float]
    thresholds: Mapping[float, float]

    def number(self, scene: Pocket) -> float:
        """The product of powers; of several grooves the deepest and steepest count."""
        factors: list[float] = [getattr(scene, name) ** power for name, power in self.powers.items()]
        return math.prod(factors)

    def within(self, scene: Pocket) -> float | None:
        """The smallest tolerance that the load is expected to keep, None beyond the last threshold or the sweep."""
        if _beyond(scene):
            return None
        number = self.number(scene)
        return min((t for t, limit in self.thresholds.items() if number <= limit), default=None)

    def told(self, scene: Pocket) -> str:
        """What is to be expected, in words."""
        if beyond := _beyond(scene):
            return beyond
        kept, worst = self.within(scene), max(self.thresholds)
        found = f"{words(self.powers)} = {self.number(scene):.3g}"
        if kept is None:
            return f"{found}: load more than {worst:.0%} off where this is above {self.thresholds[worst]:.3g}"
        return f"{found}: load within {kept:.0%} up to {self.thresholds[kept]:.3g}"

    def applicability(self, scene: Pocket, words_before: str) -> Applicability:
        """What a model says of a scene: these words, then what is to be expected."""
        return Applicability(applies=True, reason=f"{words_before}; {self.told(scene)}")


def _beyond(scene: Pocket) -> str:
    """Why nothing is known of grooves like these, "" where they were compared; rounding counts for nothing."""
    narrowest = min(groove.width for groove in scene.grooves) / scene.geometry.film
    if narrowest < NARROWEST * (1 - 1e-9):
        return f"w/Ly = {narrowest:.3g}: loads were compared for grooves of {NARROWEST:g} film thicknesses and more"
    if scene.aspect > DEEPEST * (1 + 1e-9):
        return f"2d/w = {scene.aspect:.3g}: loads were compared for grooves up to {DEEPEST:g}"
    return ""


def words(powers: Mapping[str, float]) -> str:
    """A product of powers as people write it."""

    def factor(symbol: str, power: float) -> str:
        return symbol if power == 1 else f"{symbol if symbol.isalpha() else f'({symbol})'}^{power:g}"

    left = dict(powers)
    told = []
    if left.get("aspect") and left.get("aspect") == -left.get("depth", 0):
        told = [factor("2Ly/w", left.pop("aspect"))]
        del left["depth"]
    return " · ".join([*(factor(SYMBOLS[name], power) for name, power in left.items()), *told])
