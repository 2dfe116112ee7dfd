"""How far a model may be trusted on a scene: the number that orders its errors, and up to where it kept a tolerance."""

from collections.abc import Mapping
from dataclasses import dataclass

from rom.ladder import Applicability
from rom.scene import Scene

SYMBOLS = {"reynolds_number": "Re", "depth": "(d/Ly)", "slope": "(2d/w)"}


@dataclass(frozen=True, kw_only=True)
class ErrorLaw:
    """Error in load of a model, ordered by a product of powers of Re, d/Ly and the slope 2d/w of a scene.

    ``thresholds`` gives for each tolerance the number up to which 95 of 100 cases of a sweep kept it, against the best
    rung: grooves of w/Lx = 0.15 to 0.5, d/Ly = 0.25 to 1.25, cylindrical and splined, Re = 40 to 160, Ly/Lx = 0.03
    (scripts/studies/paper_a.toml, judged by ``roughfilm report``).
    """

    powers: Mapping[str, float]
    thresholds: Mapping[float, float]

    def number(self, scene: Scene) -> float:
        """The product of powers for the deepest and steepest groove of a scene."""
        features = {"reynolds_number": scene.reynolds_number, "depth": scene.depth, "slope": scene.slope}
        value = 1.0
        for name, power in self.powers.items():
            value *= features[name] ** power
        return value

    def within(self, scene: Scene) -> float | None:
        """The smallest tolerance that the load is expected to keep, None beyond the last threshold."""
        number = self.number(scene)
        return min((t for t, limit in self.thresholds.items() if number <= limit), default=None)

    def told(self, scene: Scene) -> str:
        """What is to be expected, in words."""
        kept, worst = self.within(scene), max(self.thresholds)
        found = f"{words(self.powers)} = {self.number(scene):.3g}"
        if kept is None:
            return f"{found}: load more than {worst:.0%} off where this is above {self.thresholds[worst]:.3g}"
        return f"{found}: load within {kept:.0%} up to {self.thresholds[kept]:.3g}"

    def applicability(self, scene: Scene, words_before: str) -> Applicability:
        """What a model says of a scene: these words, then what is to be expected."""
        return Applicability(applies=True, within=self.within(scene), reason=f"{words_before}; {self.told(scene)}")


def words(powers: Mapping[str, float]) -> str:
    """A product of powers as people write it."""
    return " ".join(SYMBOLS[name] + ("" if power == 1 else f"^{power:g}") for name, power in powers.items())
