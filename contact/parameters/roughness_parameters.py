"""All roughness parameters of a surface or a profile, with their units."""

from collections.abc import Mapping
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.parameters.bearing_curve import (
    Core,
    bearing_core,
    descending,
    height_at_ratio,
    material_volume,
    void_volume,
)
from roughfilm.contact.parameters.definitions import AREAL, PROFILE, Definition
from roughfilm.contact.parameters.features import significant_peaks, significant_pits
from roughfilm.contact.parameters.gradient import developed_area, rms_gradient
from roughfilm.contact.parameters.heights import deviations, height_statistics
from roughfilm.contact.parameters.peaks import highest_peaks, lowest_valleys
from roughfilm.contact.parameters.profile import SECTIONS, profile_elements, rms_profile_gradient, section_heights
from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.surfaces.surface import Surface

PEAKS_END, CORE_END = 0.1, 0.8
"""Material ratios that separate peaks, core and valleys in the volume parameters (ISO 25178-3)."""

EXTREME_RATIO, MEDIAN_RATIO = 0.025, 0.5
"""Material ratios between which Sxp is taken (ISO 25178-3)."""


def parameters(surface: Surface) -> dict[str, Quantity]:
    """Areal roughness parameters of ISO 25178-2, and St, Spm, Svm of the thesis, over the valid points.

    The surface is neither filtered nor levelled; heights are measured from their mean. `definitions.AREAL` defines each
    parameter.

    Returns
    -------
    dict : Sa, Sq, Sp, Sv, Sz, St, m; Ssk, Sku (`heights`); Sk, Spk, Svk, m; Smr1, Smr2; Sxp, m; Vmp, Vmc, Vvc, Vvv,
        m³/m² (`bearing_curve`); Sdq, Sdr (`gradient`); Sal, m; Str (`autocorrelation`); Std, degrees (`spectrum`); Spd,
        1/m²; Spc, 1/m; S5p, S5v, S10z, m (`features`); Spm and Svm, m, the means of the five highest peaks and the five
        lowest valleys, no two within Sal (`peaks`). What a surface does not have is left out: Sdq and Sdr where no
        valid points are neighbours; Spc, S5p, S5v and S10z without a significant peak or pit.

    Raises
    ------
    InputError
        If all heights are equal.
    """
    ordered = descending(surface.heights[surface.valid])
    statistics = height_statistics(ordered)
    decay = decay_lengths(autocorrelation(surface), surface.spacing)
    peaks, pits = significant_peaks(surface), significant_pits(surface)
    high, low = peaks.five_point_height, pits.five_point_height
    return _quantities(
        AREAL,
        {
            "Sa": statistics.average,
            "Sq": statistics.rms,
            "Sp": statistics.peak,
            "Sv": statistics.valley,
            "Sz": statistics.total,
            "St": statistics.total,
            "Ssk": statistics.skewness,
            "Sku": statistics.kurtosis,
            **_core("S", bearing_core(ordered)),
            "Sxp": height_at_ratio(ordered, EXTREME_RATIO) - height_at_ratio(ordered, MEDIAN_RATIO),
            **_volumes(ordered),
            "Sdq": rms_gradient(surface),
            "Sdr": developed_area(surface),
            "Sal": decay.shortest,
            "Str": decay.aspect,
            "Std": texture_direction(power_spectrum(surface)),
            "Spd": peaks.density,
            "Spc": peaks.mean_curvature,
            "S5p": high,
            "S5v": low,
            "S10z": None if high is None or low is None else high + low,
            "Spm": float(highest_peaks(surface, decay.shortest).mean()),
            "Svm": float(lowest_valleys(surface, decay.shortest).mean()),
        },
    )


def profile_parameters(
    heights: ArrayLike, spacing: float, *, sections: int = SECTIONS, profile: Literal["P", "W", "R"] = "R"
) -> dict[str, Quantity]:
    """Parameters of ISO 21920-2 of one profile, neither filtered nor levelled; heights are measured from their mean.

    Rp, Rv and Rz are means over section lengths, all others are those of the whole evaluation length, as in ISO 21920-2
    (ISO 4287 had averaged Ra, Rq, Rsk and Rku over sampling lengths too). `definitions.PROFILE` defines each parameter.

    Parameters
    ----------
    heights : shape (n,), m, equidistant; valid points only.
    spacing : distance of neighbouring points, m.
    sections : number of section lengths, 1 to n.
    profile : first letter of the names: of a primary profile, a waviness profile or a roughness profile.

    Returns
    -------
    dict : Ra, Rq, Rt, Rp, Rv, Rz, m; Rsk, Rku; Rk, Rpk, Rvk, m; Rmr1, Rmr2 (`bearing_curve`); Rdq; Rsm, Rc, m
        (`profile`), which are left out if there is no complete profile element. `bearing_curve.bearing_curve` gives the
        curve, `bearing_curve.material_ratio` Rmr(c) and `bearing_curve.height_at_ratio` Rmc(p).

    Raises
    ------
    InputError
        If the array has another number of dimensions, a height is not finite, all heights are equal, or another
        argument is out of range.
    """
    shape = np.shape(heights)
    if len(shape) != 1:
        raise InputError(f"profile: got heights of shape {shape}; give one line of them")
    if not 0 < spacing < np.inf:
        raise InputError(f"spacing: got {spacing!r} m; give the distance of neighbouring points, above 0")
    if profile not in ("P", "W", "R"):
        raise InputError(f"profile: got {profile!r:.20}; give the letter 'P', 'W' or 'R'")
    z = deviations(heights)
    ordered = descending(heights)
    statistics, section = height_statistics(ordered), section_heights(z, sections)
    elements = profile_elements(z, spacing, section)
    found = _quantities(
        PROFILE,
        {
            "Ra": statistics.average,
            "Rq": statistics.rms,
            "Rt": statistics.total,
            "Rp": section.peak,
            "Rv": section.valley,
            "Rz": section.total,
            "Rsk": statistics.skewness,
            "Rku": statistics.kurtosis,
            **_core("R", bearing_core(ordered)),
            "Rdq": rms_profile_gradient(z, spacing),
            "Rsm": None if elements is None else float(elements.spacings.mean()),
            "Rc": None if elements is None else float(elements.heights.mean()),
        },
    )
    return {profile + name[1:]: quantity for name, quantity in found.items()}


def _core(letter: str, core: Core) -> dict[str, float]:
    return {
        f"{letter}k": core.height,
        f"{letter}pk": core.peak,
        f"{letter}vk": core.valley,
        f"{letter}mr1": core.peak_ratio,
        f"{letter}mr2": core.valley_ratio,
    }


def _volumes(ordered: Array) -> dict[str, float]:
    """Vmp, Vmc, Vvc and Vvv, m³/m²."""
    peaks, valleys = material_volume(ordered, PEAKS_END), void_volume(ordered, CORE_END)
    return {
        "Vmp": peaks,
        "Vmc": material_volume(ordered, CORE_END) - peaks,
        "Vvc": void_volume(ordered, PEAKS_END) - valleys,
        "Vvv": valleys,
    }


def _quantities(definitions: Mapping[str, Definition], values: Mapping[str, float | None]) -> dict[str, Quantity]:
    """The values that are known, with their units."""
    return {
        name: Quantity(value=value, unit=definitions[name].unit) for name, value in values.items() if value is not None
    }
