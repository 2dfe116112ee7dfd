"""The limits of laminar flow in films, and the sentences that say where a film is beyond them."""

import math

SHEAR_LIMIT = 1440.0
"""Re = ρuh/η at which plane shear flow becomes turbulent: 360 in terms of half the speed and half the gap.

Source: Tillmark and Alfredsson 1992, doi:10.1017/S0022112092001046.
"""

PRESSURE_LIMIT = 1300.0
"""Re = ρq/η of the flow per width q at which flow between plates becomes turbulent: 1000 with half the gap and the
centre speed.

Source: Carlson, Widnall and Peeters 1982, doi:10.1017/S0022112082002006.
"""

TAYLOR = 41.2
"""Re √(c/R) of a shaft that turns in a bore, Re = ρuc/η, at which Taylor vortices form.

Source: Taylor 1923, doi:10.1098/rsta.1923.0008, in the limit of a clearance c that is small beside the radius R.
"""


def shear_turbulence(number: float) -> tuple[str, ...]:
    """The sentence for a Reynolds number ρuh/η of the sliding above ``SHEAR_LIMIT``; none below it."""
    return _beyond(number, SHEAR_LIMIT, "Re = ρuh/η", "above which shear flow is turbulent")


def pressure_turbulence(number: float) -> tuple[str, ...]:
    """The sentence for a Reynolds number ρq/η of the flow by pressure above ``PRESSURE_LIMIT``; none below it."""
    return _beyond(number, PRESSURE_LIMIT, "Re = ρq/η", "above which the flow that pressure drives is turbulent")


def taylor_vortices(number: float, radius: float, clearance: float) -> tuple[str, ...]:
    """The sentence for a Reynolds number ρuc/η between cylinders above 41.2 √(R/c); none below it.

    Parameters
    ----------
    number : Reynolds number ρuc/η.
    radius, clearance : radius R of the shaft and radial clearance c, m.
    """
    limit = TAYLOR * math.sqrt(radius / clearance)
    return _beyond(number, limit, "Re = ρuc/η", f"{TAYLOR:g} √(R/c), above which Taylor vortices form")


def _beyond(number: float, limit: float, name: str, meaning: str) -> tuple[str, ...]:
    if not number > limit:
        return ()
    return (f"{name} = {number:.4g} exceeds {limit:.4g}, {meaning}",)
