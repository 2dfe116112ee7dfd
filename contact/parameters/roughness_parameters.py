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
    """Areal roughness parameters of ISO 25178-2, and the thesis's St, Spm, Svm, of the valid points.

    Nothing is filtered or levelled; heights count from their mean, which is taken out.

    Returns
    -------
    Sa, Sq, Sp, Sv, Sz, m; Ssk, Sku (`heights`); Sk, Spk, Svk, m; Smr1, Smr2, ratios (`bearing_curve`);
    Sal, m; Str (`autocorrelation`); Std, degrees (`spectrum`); St = Sz, and Spm, Svm, m: mean of the
    five highest peaks and of the five lowest valleys, no two within Sal (`peaks`).

    Raises
    ------
    InputError
        If all heights are the same.
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


def bearing_parameters(surface: Surface) -> dict[str, Quantity]:
    """Sk, Spk, Svk, m, and Smr1, Smr2, ratios, of the valid points (`bearing_curve`): a part of `parameters`."""
    return _core("S", bearing_core(descending(surface.heights[surface.valid])))


def profile_parameters(heights: ArrayLike) -> dict[str, Quantity]:
    """Roughness parameters of ISO 21920-2 of one profile, over its whole length; nothing is filtered or levelled.

    Parameters
    ----------
    heights : shape (n,), m, at equal distances: valid points only.

    Returns
    -------
    Ra, Rq, Rt, m; Rsk, Rku; Rk, Rpk, Rvk, m; Rmr1, Rmr2, ratios. The curve itself is `bearing_curve.bearing_curve`.

    Raises
    ------
    InputError
        If the heights are not one profile, one is not finite, or all are the same.
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
