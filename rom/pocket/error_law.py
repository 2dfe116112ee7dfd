"""Expected error of a model over a product of the scene's dimensionless numbers."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from roughfilm.rom.ladder.model import Applicability
from roughfilm.rom.pocket.scene import Pocket

SYMBOLS = {"reynolds_number": "Re", "depth": "d/Ly", "aspect": "2d/w", "slope": "slope"}
"""Symbols of the numbers; ``slope`` is that of the steeper side of a groove, 2d/w for a symmetric one."""

MIN_WIDTH = 5.0
"""Smallest w/Ly of the grooves in the sweep."""

MAX_ASPECT = 0.5
"""Largest 2d/w of the grooves in the sweep."""


@dataclass(frozen=True, kw_only=True)
class ErrorLaw:
    """Load error of a model over a product of powers of Re, d/Ly, 2d/w and slope of a scene.

    ``thresholds`` gives for each tolerance the largest number up to which 95 of 100 cases of a sweep meet it, compared
    with the most complete model: cylindrical and splined grooves of w/Lx = 0.15 to 0.5 and d/Ly = 0.25 to 1.25,
    Re = 40 to 160, Ly/Lx = 0.03 (scripts/examples/studies/paper_a.toml and ``roughfilm report``).
    """

    powers: Mapping[str, float]
    thresholds: Mapping[float, float]

    def number(self, scene: Pocket) -> float:
        """The product of powers, of the deepest and steepest among several grooves."""
        factors: list[float] = [getattr(scene, name) ** power for name, power in self.powers.items()]
        return math.prod(factors)

    def within(self, scene: Pocket) -> float | None:
        """The smallest tolerance that the load is expected to meet; None above the last threshold or off the sweep."""
        if _outside_sweep(scene):
            return None
        number = self.number(scene)
        return min((t for t, limit in self.thresholds.items() if number <= limit), default=None)

    def described(self, scene: Pocket) -> str:
        """The expected load error in words."""
        if outside := _outside_sweep(scene):
            return outside
        within, worst = self.within(scene), max(self.thresholds)
        number = f"{product_text(self.powers)} = {self.number(scene):.3g}"
        if within is None:
            return f"{number}: load error above {worst:.0%} where this is above {self.thresholds[worst]:.3g}"
        return f"{number}: load within {within:.0%} up to {self.thresholds[within]:.3g}"

    def applicability(self, scene: Pocket, effects: str) -> Applicability:
        """The applicability of a model that keeps these effects, with its expected load error."""
        return Applicability(applies=True, reason=f"{effects}; {self.described(scene)}")


def _outside_sweep(scene: Pocket) -> str:
    """The reason why the grooves lie outside the sweep by more than round-off; "" inside."""
    narrowest = min(groove.width for groove in scene.grooves) / scene.geometry.film
    if narrowest < MIN_WIDTH * (1 - 1e-9):
        return f"w/Ly = {narrowest:.3g}: loads were compared for grooves of {MIN_WIDTH:g} film thicknesses and more"
    if scene.aspect > MAX_ASPECT * (1 + 1e-9):
        return f"2d/w = {scene.aspect:.3g}: loads were compared for grooves up to {MAX_ASPECT:g}"
    return ""


def product_text(powers: Mapping[str, float]) -> str:
    """A product of powers as text, such as ``Re · 2d/w``."""

    def factor(symbol: str, power: float) -> str:
        return symbol if power == 1 else f"{symbol if symbol.isalpha() else f'({symbol})'}^{power:g}"

    left = dict(powers)
    ratio = []
    if left.get("aspect") and left.get("aspect") == -left.get("depth", 0):
        ratio = [factor("2Ly/w", left.pop("aspect"))]
        del left["depth"]
    return " · ".join([*(factor(SYMBOLS[name], power) for name, power in left.items()), *ratio])
