"""The rungs of contact: solved on the grid, or estimated from statistics of the heights."""

import math
import time
from collections.abc import Callable
from enum import StrEnum
from functools import partial

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.estimates.greenwood_williamson import greenwood_williamson
from roughfilm.contact.mechanics.estimates.persson import persson
from roughfilm.contact.mechanics.estimates.truncation import bearing_area
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.store import Row


class Model(StrEnum):
    """The rung."""

    BEARING_AREA = "bearing_area"
    GREENWOOD_WILLIAMSON = "greenwood_williamson"
    PERSSON = "persson"
    ELASTIC = "elastic"
    ELASTIC_PLASTIC = "elastic_plastic"
    STANLEY_KATO = "stanley_kato"


SOLVED = (Model.ELASTIC, Model.ELASTIC_PLASTIC, Model.STANLEY_KATO)
"""The rungs that solve on the grid; the others estimate from statistics."""

WITHOUT_HARDNESS = (Model.ELASTIC, Model.GREENWOOD_WILLIAMSON)

SOURCES = {
    Model.BEARING_AREA: "E. J. Abbott, F. A. Firestone, Mech. Eng. 55 (1933) 569",
    Model.GREENWOOD_WILLIAMSON: "J. A. Greenwood, J. B. P. Williamson, doi:10.1098/rspa.1966.0242",
    Model.PERSSON: "B. N. J. Persson, doi:10.1063/1.1388626",
    Model.ELASTIC: "I. A. Polonsky, L. M. Keer, doi:10.1016/S0043-1648(99)00113-1",
    Model.ELASTIC_PLASTIC: "F. Sahlin, Luleå University of Technology 2008:26, section E.2.2",
    Model.STANLEY_KATO: "H. M. Stanley, T. Kato, doi:10.1115/1.2833523",
}


def chosen(model: Model | None, hardness: float) -> Model:
    """The model asked for, or the best one that the hardness allows."""
    found = model or (Model.ELASTIC if math.isinf(hardness) else Model.ELASTIC_PLASTIC)
    if math.isinf(hardness) and found in (Model.ELASTIC_PLASTIC, Model.BEARING_AREA):
        raise InputError(f"--hardness: {found} needs one; give it, such as --hardness 4GPa, or choose --model elastic")
    return found


def estimator(
    model: Model, heights: Array, spacing: tuple[float, float], composite_modulus: float, hardness: float
) -> Callable[[float], tuple[Row, Estimate]]:
    """What a statistical rung gives at a load: its numbers, and all of its estimate."""
    if model is Model.BEARING_AREA:
        estimate = partial(bearing_area, heights, hardness=hardness, **_stiffness(heights, spacing, composite_modulus))
    else:
        spectrum = wave_power(heights, spacing)
        if model is Model.PERSSON:
            estimate = partial(persson, spectrum, composite_modulus=composite_modulus, hardness=hardness)
        else:
            estimate = partial(greenwood_williamson, spectrum.moments, composite_modulus=composite_modulus)

    def row(load: float) -> tuple[Row, Estimate]:
        started = time.process_time()
        found = estimate(load=load)
        return (
            Row(
                load=load,
                area_fraction=found.area_fraction,
                area_fraction_pixel=None,
                plastic_fraction=found.plastic_fraction,
                mean_gap=found.mean_gap,
                approach=None,
                complementarity=None,
                iterations=None,
                pressure_max=hardness if found.plastic_fraction > 0 else None,
                cpu_s=time.process_time() - started,
            ),
            found,
        )

    return row


def _stiffness(heights: Array, spacing: tuple[float, float], composite_modulus: float) -> dict[str, float]:
    """What tells whether a bearing curve is to be trusted; nothing of a flat surface, of which it knows all."""
    if np.ptp(heights) == 0:
        return {}
    return {"composite_modulus": composite_modulus, "rms_slope": wave_power(heights, spacing).moments.rms_slope}
