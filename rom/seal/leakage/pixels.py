"""Uncertainty of a permeability by the pixels of the contact."""

import math
from dataclasses import replace

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.discretisation import uncertainties
from roughfilm.rom.homogenization.flux import widening
from roughfilm.rom.seal.leakage.passage import Passage


def with_pixels(passage: Passage, contact: Contact, direction: int) -> Passage:
    """The passage through the gap of a contact, with the uncertainty of that gap in the one of its permeability.

    The uncertainty δ of the mean gap by the pixels changes K by δ ∂K/∂h for a uniform change of the open gap (see
    :func:`roughfilm.rom.homogenization.flux.widening`). It adds in squares to the uncertainty of the flow through a
    given gap. A sealed passage does not change.

    Parameters
    ----------
    passage : the flow through ``contact.gap``, with a corrector on the nodes of the contact.
    contact : of a surface, shape (nx, ny), nx, ny >= 2.
    direction : 0 for flow in x, 1 in y.

    Notes
    -----
    On 560 random seals of 48 x 48 points in x and in y (``scripts.studies.coverage``, seeds from 10000), compared with
    192 x 192 points, the sum covers 97 of 100 homogenized permeabilities, and one in 1000 is off by more than three
    times it; without this part these are 76 and 10 of 100.
    """
    if passage.sealed:
        return passage
    rate = widening(contact.gap, contact.spacing, passage.corrector, direction)
    return replace(passage, uncertainty=math.hypot(passage.uncertainty, uncertainties(contact)["mean_gap"] * rate))
