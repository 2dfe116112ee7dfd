"""The error of a contact by the preparation of its surface, which no model of a scene includes."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from roughfilm.rom.advice.stated import percent
from roughfilm.rom.ladder.kind import Omission
from roughfilm.rom.parts.pressed_surface import RoughContact

SOURCE = "estimated from the preparation of the surface"
"""Source of an error that consists mostly of it."""


@dataclass(frozen=True, kw_only=True)
class PreparationError:
    """The error of a quantity, over its value for the complete surface: a s + b t √p + c √(f/n) + d √(f/n) p^(-1/4).

    s and t are the falls of slope and height, f the fraction that is lost and n the number of waves of
    :class:`roughfilm.contact.preparation.change.PreparationChange`, p the load over E* g'. The number of contacts grows
    as n √p.
    """

    title: str
    slope: float
    height: float = 0.0
    waves: float = 0.0
    contacts: float = 0.0

    def of(self, change: Mapping[str, float], load: float) -> float:
        """The error of a change under a load over E* g'."""
        lost = math.sqrt(change["lost"] / change["waves"]) if change["waves"] > 0 else math.inf
        scatter = self.waves + self.contacts / math.sqrt(math.sqrt(load))
        return self.slope * change["slope"] + self.height * change["height"] * math.sqrt(load) + scatter * lost


LAWS = {
    "area_fraction": PreparationError(title="contact area", slope=1.4, contacts=0.34),
    "mean_gap": PreparationError(title="mean gap", slope=0.9, height=2.0, waves=1.07),
    "mean_contact_pressure": PreparationError(title="mean contact pressure", slope=1.0, contacts=0.22),
    "approach": PreparationError(title="approach", slope=1.4, waves=0.97),
    "pressure_max": PreparationError(title="peak pressure", slope=1.65, contacts=0.18),
    "leakage_per_width": PreparationError(title="leakage", slope=2.1, height=43.0, waves=5.5),
    "permeability": PreparationError(title="permeability", slope=2.1, height=43.0, waves=5.5),
}
"""The laws of the quantities, for 95 of 100 contacts.

Those of contacts are quantile regressions over maps of 16 to 64 points a side with up to 60 % of invalid points
(``scripts.studies.coverage``, kind ``small_surface``, seeds from 10000), with slopes that contain the effect of the
moving average on three larger measured surfaces as well; those of the leakage are for the same maps at 0.002 to
0.5 E* g'.
"""

MAX_LOGARITHM = 100.0
"""Largest logarithm of a ratio that is stated."""

LOGARITHMIC = frozenset({"area_fraction", "leakage_per_width", "permeability"})
"""Quantities whose law is that of the logarithm of the ratio to the value for the complete surface."""


def error_of_preparation(scene: RoughContact, quantity: str) -> Omission | None:
    """The error of a quantity by the preparation of the surface; None for a surface that was not prepared or changed.

    It is unknown, thus infinite, where the preparation removed spots that may be a texture.
    """
    record = scene.surface().source.get("record", {})
    change, law = record.get("change"), LAWS.get(quantity)
    if change is None or law is None:
        return None
    if doubts := record["outliers"]["doubts"]:
        return Omission(part=math.inf, reason=doubts[0], source=SOURCE)
    part = law.of(change, scene.load.pressure / scene.pressure_unit)
    if part == 0:
        return None
    if quantity in LOGARITHMIC:
        part = math.expm1(min(part, MAX_LOGARITHM))
    size = f"up to {percent(part)}" if part <= 1 else "more than 100 %"
    return Omission(
        part=part,
        reason=f"the preparation of the surface (smoothing, form, filled points and joined edges) changes the "
        f"{law.title} by {size}",
        source=SOURCE,
    )
