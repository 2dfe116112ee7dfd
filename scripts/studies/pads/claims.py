"""The claims of Dobrica and Fillon 2009 with verdicts."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from scripts.studies.pads.data import RISES, Pad, PadStudy, finite
from scripts.studies.study import Claim, claims_of, verdict

INLET = ("inlet half", 1.0, 0.0)
FULL = ("full", 1.0, 0.0)
INCLINED = ("inlet half", 1.0, RISES[1])

NOTICEABLE = 0.01
"""Relative change of the load below which inertia is not noticed."""

ENOUGH = 0.05
"""Relative difference from the Reynolds equation up to which that equation is enough."""


def judge(study: PadStudy) -> list[Claim]:
    """Judge the claims."""
    return claims_of(__file__, {1: _partial(study), 2: _cells(study), 3: _aspect(study)})


def relative(study: PadStudy, name: tuple[str, float, float]) -> Array:
    """The change of the load by inertia over the load by the Reynolds equation, shape (ratios, numbers).

    It is NaN where a pad carries nothing without inertia, as a parallel one that is textured throughout.
    """
    return study.map(name, lambda pad: study.by_inertia(pad) / (study.without(pad) or np.nan))


def reduced(study: PadStudy) -> Array:
    """Re/λ of every pad of a map, shape (ratios, numbers)."""
    return np.asarray(np.array(study.plan.numbers) / np.array(study.plan.ratios)[:, None])


def _partial(study: PadStudy) -> tuple[str, str]:
    change, number = relative(study, INLET), reduced(study)
    negative, positive = change < -NOTICEABLE, change > NOTICEABLE
    known = np.isfinite(change)
    lowest = float(number[negative].min()) if negative.any() else np.inf
    highest = float(number[positive].max()) if positive.any() else 0.0
    values, inclined = (100 * finite(one.ravel()) for one in (change, relative(study, INCLINED)))
    evidence = (
        "parallel pad, pockets as deep as the film on its inlet half: inertia changes the load by "
        f"{values.min():+.0f} to {values.max():+.1f} %; it takes more than 1 % in {negative.sum()} of {known.sum()} "
        f"pads, all with Re/λ of at least {lowest:.2g}, and adds more than 1 % in {positive.sum()}"
        + (f", all with Re/λ of at most {highest:.2g}" if positive.any() else "")
        + f"; of an inclined pad, rise h/2, it changes the load by {inclined.min():+.1f} to {inclined.max():+.0f} %"
    )
    return verdict(bool(negative.any() and not (change > 0).any()), partly=bool(negative.any())), evidence


def _cells(study: PadStudy) -> tuple[str, str]:
    def ratio(pad: Pad) -> float:
        return study.by_cells(pad) / study.by_inertia(pad)

    partial, by_cells = relative(study, INLET), study.map(INLET, study.by_cells)
    wrong = (partial < -NOTICEABLE) & (by_cells > 0)
    taken = int((partial < -NOTICEABLE).sum())
    ratios, few = study.map(FULL, ratio), reduced(study) < 1
    full, least = finite(ratios[few]), finite(ratios.ravel()).min()
    evidence = (
        f"where inertia takes more than 1 % of the load of the inlet half, single cells predict that it adds load in "
        f"{wrong.sum()} of {taken} pads; of fully textured parallel pads they predict {full.min():.2f} to "
        f"{full.max():.2f} of the load by inertia where Re/λ < 1, and {least:.2f} at the largest Re/λ"
    )
    return verdict(bool(taken and wrong.sum() == taken), partly=bool(wrong.any())), evidence


def _aspect(study: PadStudy) -> tuple[str, str]:
    error = study.map(INLET, lambda pad: abs(study.load(pad, "film_slope") / study.without(pad) - 1))
    limits = [
        next((number for number, one in zip(study.plan.numbers, row, strict=True) if one > ENOUGH), np.inf)
        for row in error
    ]
    shown = ", ".join(
        f"{'above ' + format(study.plan.numbers[-1], 'g') if np.isinf(limit) else format(limit, 'g')} at λ = {ratio:g}"
        for ratio, limit in zip(study.plan.ratios, limits, strict=True)
    )
    evidence = (
        f"the load of the inlet half differs by more than 5 % from the Reynolds equation from Re on of: {shown}; the "
        "number that decides is Re/λ, beside a difference by slope that grows as 1/λ falls"
    )
    return verdict(limits[-1] > 2 * limits[0], partly=limits[-1] > limits[0]), evidence
