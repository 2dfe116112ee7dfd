"""Ambient pressure, and warnings where a film without cavitation would rupture."""

from typing import Annotated

from roughfilm.contact.foundation.entries import InUnit, Part

ATMOSPHERE = 101325.0
"""Standard atmospheric pressure, Pa."""

GaugePressure = Annotated[float, InUnit("Pa", any_sign=True)]


class Surroundings(Part):
    """The surroundings of a film.

    Attributes
    ----------
    ambient_pressure : absolute, Pa; all other pressures count from it. By default 1 atm.
    """

    ambient_pressure: Annotated[float, InUnit("Pa")] = ATMOSPHERE

    def cavitation_pressure(self, given: float | None) -> float:
        """The cavitation pressure above ambient, Pa: the given one, by default zero absolute pressure.

        Raises
        ------
        ValueError
            If it is above ambient or below zero absolute pressure.
        """
        vacuum = -self.ambient_pressure
        if given is not None and not vacuum <= given <= 0:
            raise ValueError(
                f"lubricant.cavitation_pressure: got {given!r} Pa; it counts from ambient and must be {vacuum!r} Pa "
                "(zero absolute pressure) to 0 Pa, change it or boundary.ambient_pressure"
            )
        return vacuum if given is None else given


def rupture_warnings(
    lowest: float, limit: float, ambient: float, *, error: float = 0.0, left_out_by: str, cause: str = "", remedy: str
) -> tuple[str, ...]:
    """A warning if the lowest pressure of a film is, or within its error may be, below the cavitation pressure.

    Parameters
    ----------
    lowest : lowest pressure of the film above ambient, Pa.
    limit : cavitation pressure above ambient, Pa.
    ambient : ambient pressure, absolute, Pa.
    error : error of the lowest pressure, Pa.
    left_out_by : the end of the sentence "the film ruptures, which ...", in words.
    cause : the drive that causes the pressure, such as ``under sliding``; "" if there is only one.
    remedy : what to do, in words.
    """
    if lowest - error >= limit:
        return ()
    certain = lowest + error < limit
    size = "" if error == 0 or certain else f" ± {error / 1e3:.2g} kPa"
    where, what = ("below", "ruptures") if certain else ("near", "may rupture or stay whole")
    return (
        f"pressure: falls {cause + ' ' if cause else ''}to {_kilopascal(lowest)}{size} from ambient, {where} the "
        f"cavitation pressure of {_kilopascal(limit)} (ambient pressure {_kilopascal(ambient)}): the film {what}, "
        f"which {left_out_by}; {remedy}",
    )


def _kilopascal(pressure: float) -> str:
    return f"{pressure / 1e3:.4g} kPa"
