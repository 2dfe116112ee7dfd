"""What every rung of a bearing leaves out, where that can be judged: inertia, to first order."""

from roughfilm.rom.bearing.effects.inertia import judged
from roughfilm.rom.bearing.inertia import inertia
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import load_loops
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.kind import Omission

CELLS = {True: 512, False: 64}
"""Of an infinitely wide film, and along the sides of others."""

ADDED = {"load_per_width": "load", "friction_per_width": "friction"}


def inertia_omitted(scene: Bearing, quantity: str) -> Omission | None:
    """By which part first-order inertia changes load or friction of the smooth film; None where that cannot be judged.

    Raises ConvergenceError if the film does not come into balance.
    """
    if judged(scene) is not None:
        return None
    load_loops(scene.wide)
    found = solve(scene.problem(), (CELLS[scene.wide],) * 2)
    width = 1.0 if scene.geometry.width is None else scene.geometry.width
    size = abs(bearing_quantities(scene, found)[quantity].value)
    part = abs(getattr(inertia(scene, found), ADDED[quantity])) / width / size if size > 0 else 0.0
    number = bearing_numbers(scene)["reduced_reynolds_number"]
    told = f"by about {100 * part:.2g} %" if part < 1 else "by more than first order can tell"
    return Omission(
        part=part,
        reason=f"Re·h/L = {number:.2g}: inertia, which no rung of a bearing keeps, changes the {ADDED[quantity]} "
        f"{told}",
    )
