"""Results of the report on rough gaps in sentences, and the judgement of claim 19 of the source."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from scripts.studies.rough_gaps.data import best
from scripts.studies.rough_gaps.map import serves
from scripts.studies.rough_gaps.range_of_validity import SurfaceValidity
from scripts.studies.rough_gaps.scenes import MILLED
from scripts.studies.rough_gaps.study import (
    MAX_FITTED_SLOPE,
    RoughGapStudy,
    bounds_hold,
    mesh_meets_exact,
    theory_meets_mesh,
)
from scripts.studies.rough_gaps.waves import MARKED, bare_coefficient
from scripts.studies.study import Claim, verdict

FEW_PER_CENT = 0.05
"""The few per cent of the claim, as a fraction of the flow."""


def judge(study: RoughGapStudy) -> list[Claim]:
    """Judge claim 19, as far as Stokes flow permits: both methods of the claim solve Reynolds' equation."""
    measured = [one for one in study.reach if one.measured]
    if not measured:
        return []
    far = [one for one in measured if max(off.error for off in one.found) > FEW_PER_CENT]
    resolved = "; ".join(f"{_error(best(one, 'A11'))} at {one.name}" for one in study.milled if one.resolved)
    said = ", ".join(f"{one.name} {_share(max(off.error for off in one.found))} (g′ = {one.slope:.2g})" for one in far)
    rest = [max(off.error for off in one.found) for one in measured if one not in far]
    return [
        Claim(
            number=19,
            text="HNS equals DNS in leakage within a few per cent for measured surfaces",
            verdict=verdict(not far, partly=bool(rest)),
            evidence="both sides of the claim solve Reynolds' equation. Its error against Stokes flow on the same "
            "heights "
            + (
                f"is, over {MILLED} in three dimensions, {resolved}; by slope correction "
                if resolved
                else "by slope correction "
            )
            + f"it is within {_share(max(rest, default=math.nan))} at every mean gap for {len(rest)} of "
            + f"{len(measured)} measured surfaces"
            + (f"; larger on steep ones: {said}" if far else ""),
        )
    ]


def _error(found: tuple[float, float]) -> str:
    ratio, bar = found
    return f"{100 * (1 / ratio - 1):.2f} ± {100 * bar / ratio**2:.2f} % too much along x"


def _share(part: float) -> str:
    return f"{100 * part:.0f} %" if part >= 1 else f"{100 * part:.2g} %"


def words(study: RoughGapStudy) -> dict[str, str]:
    """Return one or two sentences for each section."""
    return {
        "waves": _waves(study),
        "along": _along(study),
        "random": _surfaces(study, study_random=True),
        "milled": _surfaces(study, study_random=False),
        "inertia": _inertia(study),
        "reach": _reach(study.reach, study.factors),
        "map": _map(study),
    }


def _waves(study: RoughGapStudy) -> str:
    marked = [wave for length in MARKED if (wave := study.wave(0.3, length)) is not None]
    exact = ", ".join(f"{wave.exact['A11']:.4f}" for wave in marked if "A11" in wave.exact)
    said = [
        f"Waves of 0.3 of the gap, {', '.join(f'{w.length:g}' for w in marked)} gaps long, reduce the flow across their"
        f" crests to {exact} of that by Reynolds' equation."
        if marked
        else ""
    ]
    mesh = mesh_meets_exact(study.waves.resolved)
    if mesh.count:
        said.append(
            f"OpenFOAM meets the exact flow within {_share(mesh.worst)}, and within its error bars in {mesh.within} of "
            f"{mesh.count} coefficients."
        )
    drawn = [wave for wave in study.waves.drawn if "A11" in wave.exact]
    good = _up_to({wave.slope: wave.found.theory["A11"].corrected / wave.exact["A11"] - 1 for wave in drawn})
    bare = _up_to({w.slope: (1 - bare_coefficient(w.amplitude) * w.slope**2) / w.exact["A11"] - 1 for w in drawn})
    if good and bare:
        said.append(
            f"The slope correction is within 1 % of it up to an rms slope of {good:.2g} for all of these waves, the "
            f"bare law 1 − c⟨h′²⟩ up to {bare:.2g}."
        )
    return " ".join(filter(None, said))


def _up_to(errors: Mapping[float, float]) -> float:
    """Return the largest slope up to which all errors are within 1 %; 0 if there is none."""
    bad = min((slope for slope, error in errors.items() if abs(error) > 0.01), default=math.inf)
    return max((slope for slope in errors if slope < bad), default=0.0)


def _along(study: RoughGapStudy) -> str:
    wave = study.wave(0.3, 5.0)
    if wave is None or not wave.exact:
        return ""
    exact = wave.exact
    return (
        f"At a = 0.3, L = 5 the flow along the crests is {exact['A22']:.4f} of that by Reynolds' equation, the flow "
        f"dragged by sliding {exact['B1']:.4f}, and friction {exact['friction']:.4f}: slope reduces pressure flow "
        f"most, friction least."
    )


def _surfaces(study: RoughGapStudy, *, study_random: bool) -> str:
    gaps = study.random if study_random else study.milled
    if not gaps:
        return ""
    meeting, bounds = theory_meets_mesh(gaps), bounds_hold(gaps)
    ratios = [best(one, name)[0] for one in gaps for name in ("A11", "A22")]
    slopes = list(dict.fromkeys(f"{slope:.2g}" for slope in sorted(one.slope for one in gaps)))
    steepness = f"rms slopes of {slopes[0]} to {slopes[-1]}" if len(slopes) > 1 else f"an rms slope of {slopes[0]}"
    said = f"In {len(gaps)} gaps over {steepness} Stokes flow is {max(ratios):.3f} to {min(ratios):.3f} of Reynolds'."
    if not meeting.count:
        return said
    gentle = theory_meets_mesh([one for one in gaps if one.slope < MAX_FITTED_SLOPE])
    where = (
        f"{_share(gentle.worst)} where the rms slope is below {MAX_FITTED_SLOPE:g} and within "
        f"{_share(meeting.worst)} everywhere"
        if meeting.worst > gentle.worst
        else _share(meeting.worst)
    )
    return (
        f"{said} The slope correction, without a mesh, meets it within {where}; {meeting.within} of {meeting.count} "
        f"within the error bars of both. {bounds.within} of {bounds.count} lie between the bounds."
    )


def _inertia(study: RoughGapStudy) -> str:
    if not study.inertia.laws:
        return ""
    fitted = "; ".join(
        f"over {one.group} c = {one.coefficient:.2g} and b = {one.saturation:.2g}, within a factor of {one.spread:.2g} "
        f"(one standard deviation of {one.count} flows; {one.worst:.2g} at worst)"
        for one in study.inertia.laws
    )
    return (
        "Inertia reduces the flow by a fraction c (Re* g′)² / (1 + b Re* h̄/λ), up to a tenth: "
        f"{fitted}.{_crossed(study)}"
    )


def _crossed(study: RoughGapStudy) -> str:
    said = []
    for level in (0.01, 0.05):
        places = [x for _, x in study.inertia.crossings(level).values()]
        if places:
            said.append(f"{100 * level:.0f} % at Re* g′ = {min(places):.2g} to {max(places):.2g}")
    return f" Gap by gap, {' and '.join(said)}." if said else ""


def _reach(reach: Sequence[SurfaceValidity], factors: Sequence[float]) -> str:
    if not factors:
        return ""
    middle = float(np.median(factors))
    slopes = [math.sqrt(level / max(factors)) for level in (0.01, 0.05)]
    measured = [one for one in reach if one.measured]
    group = measured or list(reach)
    counts = [sum(_within(one, level) for one in group) for level in (0.01, 0.05)]
    return (
        f"The flow by Reynolds' equation is too large by about {middle:.2g} g′² ({min(factors):.2g} to "
        f"{max(factors):.2g}), g′ being the rms slope, at nearly every mean gap: a thicker film helps little. The "
        f"error is within 1 % where g′ is below {slopes[0]:.2g} ({math.degrees(math.atan(slopes[0])):.0f}°) and "
        f"within 5 % below {slopes[1]:.2g} ({math.degrees(math.atan(slopes[1])):.0f}°). Of {len(group)} "
        f"{'measured' if measured else 'made'} surfaces {counts[0]} are within 1 % and {counts[1]} within 5 % at every "
        "mean gap that keeps the walls apart."
    )


def _within(one: SurfaceValidity, level: float) -> bool:
    return max(off.error + off.bar for off in one.found) <= level


def _map(study: RoughGapStudy) -> str:
    if not study.map:
        return ""
    said = []
    for level in (0.01, 0.05):
        plain, corrected = (serves(study.map, name, level) for name in ("homogenized", "slope_corrected"))
        said.append(
            f"within {100 * level:.0f} % Reynolds' equation suits waves of every length up to an rms slope of "
            f"{plain:.2g}, the slope correction up to {corrected:.2g}"
        )
    text = "; ".join(said)
    return f"{text[0].upper()}{text[1:]}. Steeper waves need a mesh unless they are long or short enough."


def cards(study: RoughGapStudy) -> list[dict[str, str]]:
    """Return the key numbers for the head of the page."""
    said = []
    wave = study.wave(0.3, 5.0)
    if wave is not None and wave.exact:
        said.append(
            {
                "value": f"{wave.exact['A11']:.3f}",
                "words": "Stokes over Reynolds across waves of 0.3 of the gap, 5 gaps long",
            }
        )
    if study.factors:
        said.append(
            {
                "value": f"{np.median(study.factors):.2g} g′²",
                "words": "is the excess flow by Reynolds' equation over real surfaces",
            }
        )
        slopes = [math.sqrt(level / max(study.factors)) for level in (0.01, 0.05)]
        said.append(
            {
                "value": f"g′ < {slopes[0]:.2g} and {slopes[1]:.2g}",
                "words": "are the rms slopes at which its error is within 1 % and 5 %",
            }
        )
    first = study.inertia.earliest(0.01)
    if first:
        said.append(
            {"value": f"Re* g′ = {first:.2g}", "words": "is the least value at which inertia reduces a flow by 1 %"}
        )
    return said
