"""All roughness parameters of a surface or a profile, with their units."""

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.parameters.bearing_curve import Core, bearing_core, descending
from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.contact.parameters.peaks import highest_peaks, lowest_valleys
from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.surfaces.surface import Surface


def parameters(surface: Surface) -> dict[str, Quantity]:
    """Areal roughness parameters of ISO 25178-2, and St, Spm, Svm of the thesis, over the valid points.

    The surface is neither filtered nor levelled; heights are measured from their mean.

    Returns
    -------
    dict : Sa, Sq, Sp, Sv, Sz, m; Ssk, Sku (`heights`); Sk, Spk, Svk, m; Smr1, Smr2 (`bearing_curve`); Sal, m; Str
        (`autocorrelation`); Std, degrees (`spectrum`); St = Sz, m; Spm and Svm, m, the means of the five highest peaks
        and the five lowest valleys, no two within Sal (`peaks`).

    Raises
    ------
    InputError
        If all heights are equal.
    """
    ordered = descending(surface.heights[surface.valid])
    statistics = height_statistics(ordered)
    decay = decay_lengths(autocorrelation(surface), surface.spacing)
    return {
        "Sa": _length(statistics.average),
        "Sq": _length(statistics.rms),
        "Sp": _length(statistics.peak),
        "Sv": _length(statistics.valley),
        "Sz": _length(statistics.total),
        "Ssk": _number(statistics.skewness),
        "Sku": _number(statistics.kurtosis),
        **_core("S", bearing_core(ordered)),
        "Sal": _length(decay.shortest),
        "Str": _number(decay.aspect),
        "Std": Quantity(value=texture_direction(power_spectrum(surface)), unit="deg"),
        "St": _length(statistics.total),
        "Spm": _length(float(highest_peaks(surface, decay.shortest).mean())),
        "Svm": _length(float(lowest_valleys(surface, decay.shortest).mean())),
    }


def profile_parameters(heights: ArrayLike) -> dict[str, Quantity]:
    """Roughness parameters of ISO 21920-2 of one profile over its whole length, neither filtered nor levelled.

    Parameters
    ----------
    heights : shape (n,), m, equidistant; valid points only.

    Returns
    -------
    dict : Ra, Rq, Rt, m; Rsk, Rku; Rk, Rpk, Rvk, m; Rmr1, Rmr2. `bearing_curve.bearing_curve` gives the curve.

    Raises
    ------
    InputError
        If the array has another number of dimensions, a height is not finite, or all heights are equal.
    """
    shape = np.shape(heights)
    if len(shape) != 1:
        raise InputError(f"profile: got heights of shape {shape}; give one line of them")
    ordered = descending(heights)
    statistics = height_statistics(ordered)
    return {
        "Ra": _length(statistics.average),
        "Rq": _length(statistics.rms),
        "Rt": _length(statistics.total),
        "Rsk": _number(statistics.skewness),
        "Rku": _number(statistics.kurtosis),
        **_core("R", bearing_core(ordered)),
    }


def _core(letter: str, core: Core) -> dict[str, Quantity]:
    return {
        f"{letter}k": _length(core.height),
        f"{letter}pk": _length(core.peak),
        f"{letter}vk": _length(core.valley),
        f"{letter}mr1": _number(core.peak_ratio),
        f"{letter}mr2": _number(core.valley_ratio),
    }


def _length(value: float) -> Quantity:
    return Quantity(value=value, unit="m")


def _number(value: float) -> Quantity:
    return Quantity(value=value, unit="1")
