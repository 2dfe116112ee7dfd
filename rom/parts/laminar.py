"""A warning where the flow of a film is no longer laminar."""

TURBULENT = 1440.0
"""Re of the film at which plane shear flow becomes turbulent: 360 in terms of half the speed and half the gap.

Source: Tillmark and Alfredsson 1992, doi:10.1017/S0022112092001046.
"""


def turbulence_warnings(reynolds_number: float) -> tuple[str, ...]:
    """A warning if the Reynolds number ρ u h/η of a film is above ``TURBULENT``."""
    if reynolds_number <= TURBULENT:
        return ()
    return (
        f"Re = {reynolds_number:.4g} is above {TURBULENT:.0f}, where shear flow becomes turbulent; "
        "all models assume laminar, steady flow",
    )
