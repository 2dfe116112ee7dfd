"""Models of a dry contact, which solve it on the grid or estimate it from statistics of the heights."""

import math
from collections.abc import Callable
from enum import StrEnum
from functools import partial
from typing import Literal

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.contact.mechanics.estimates.greenwood_williamson import greenwood_williamson
from roughfilm.contact.mechanics.estimates.persson import persson
from roughfilm.contact.mechanics.estimates.truncation import bearing_area
from roughfilm.contact.mechanics.load_series import Solver
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.reference.stanley_kato import stanley_kato
from roughfilm.contact.mechanics.store import Row


class ContactModel(StrEnum):
    """The models of a dry contact, from the simplest to the most accurate; the last one serves for comparison."""

    BEARING_AREA = "bearing_area"
    GREENWOOD_WILLIAMSON = "greenwood_williamson"
    PERSSON = "persson"
    ELASTIC = "elastic"
    ELASTIC_PLASTIC = "elastic_plastic"
    STANLEY_KATO = "stanley_kato"


GRID_MODELS = (ContactModel.ELASTIC, ContactModel.ELASTIC_PLASTIC, ContactModel.STANLEY_KATO)
"""Models that solve the contact on the grid; the others estimate it from statistics of the heights."""

MODELS_WITHOUT_HARDNESS = (ContactModel.ELASTIC, ContactModel.GREENWOOD_WILLIAMSON)
"""Models in which the pressure has no upper limit."""

SOURCES = {
    ContactModel.BEARING_AREA: "E. J. Abbott, F. A. Firestone, Mech. Eng. 55 (1933) 569",
    ContactModel.GREENWOOD_WILLIAMSON: "J. A. Greenwood, J. B. P. Williamson, doi:10.1098/rspa.1966.0242",
    ContactModel.PERSSON: "B. N. J. Persson, doi:10.1063/1.1388626",
    ContactModel.ELASTIC: "I. A. Polonsky, L. M. Keer, doi:10.1016/S0043-1648(99)00113-1",
    ContactModel.ELASTIC_PLASTIC: "F. Sahlin, Luleå University of Technology 2008:26, section E.2.2",
    ContactModel.STANLEY_KATO: "H. M. Stanley, T. Kato, doi:10.1115/1.2833523",
}


def chosen_model(model: ContactModel | None, hardness: float) -> ContactModel:
    """The requested model, or for None the most accurate one: elastic-plastic with a hardness, elastic without.

    Parameters
    ----------
    model : the requested model, or None.
    hardness : Pa; infinite if there is none.

    Raises
    ------
    InputError
        If the requested model needs a hardness and the hardness is infinite.
    """
    found = model or (ContactModel.ELASTIC if math.isinf(hardness) else ContactModel.ELASTIC_PLASTIC)
    if math.isinf(hardness) and found in (ContactModel.ELASTIC_PLASTIC, ContactModel.BEARING_AREA):
        raise InputError(f"hardness: {found} needs one; give it, such as 4GPa, or choose the model elastic")
    return found


def solver(
    model: ContactModel,
    heights: Array,
    spacing: tuple[float, float],
    composite_modulus: float,
    *,
    hardness: float,
    boundary: Literal["periodic", "free"],
    tolerance: float,
    threads: int,
) -> Solver:
    """The function solve(load, start) that returns the contact of a grid model at a mean pressure ``load``, Pa.

    Parameters
    ----------
    model : a model in ``GRID_MODELS``.
    heights : shape (nx, ny), m.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa.
    hardness : largest pressure, Pa; infinite for an elastic contact.
    boundary : "periodic", or "free" for a surface that stands alone on the half-space.
    tolerance : largest violation of the contact conditions over the rms height.
    threads : number of threads.

    Returns
    -------
    Solver
        ``start`` is a contact at another load, or None; the model of Stanley and Kato does not use it. That model is
        always periodic and uses one thread.
    """
    body = (heights, spacing, composite_modulus)
    if model is ContactModel.STANLEY_KATO:
        return lambda load, _: stanley_kato(*body, load, hardness=hardness, tolerance=tolerance)
    press = Press(*body, hardness=hardness, boundary=boundary, threads=threads)
    return lambda load, start: press.at(load, tolerance=tolerance, start=start)


def estimator(
    model: ContactModel, heights: Array, spacing: tuple[float, float], composite_modulus: float, hardness: float
) -> Callable[[float], tuple[Row, Estimate]]:
    """The function row(load) that returns the numbers and the estimate of a statistical model at a load, Pa.

    Parameters
    ----------
    model : a model that is not in ``GRID_MODELS``.
    heights : shape (nx, ny), m.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa.
    hardness : largest pressure, Pa; infinite if there is none.
    """
    if model is ContactModel.BEARING_AREA:
        estimate = partial(bearing_area, heights, hardness=hardness, **_stiffness(heights, spacing, composite_modulus))
    else:
        spectrum = wave_power(heights, spacing)
        if model is ContactModel.PERSSON:
            estimate = partial(persson, spectrum, composite_modulus=composite_modulus, hardness=hardness)
        else:
            estimate = partial(greenwood_williamson, spectrum.moments, composite_modulus=composite_modulus)

    @imports_apart()
    def row(load: float) -> tuple[Row, Estimate]:
        started = working_time()
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
                cpu_s=working_time() - started,
            ),
            found,
        )

    return row


def _stiffness(heights: Array, spacing: tuple[float, float], composite_modulus: float) -> dict[str, float]:
    """The modulus and rms slope that limit the range of the bearing-area model; empty for a flat surface."""
    if np.ptp(heights) == 0:
        return {}
    return {"composite_modulus": composite_modulus, "rms_slope": wave_power(heights, spacing).moments.rms_slope}
