"""Laws fitted to groups of surfaces, and everything that the page of Paper F shows."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from scripts.studies.paper_f.data import Pressed
from scripts.studies.paper_f.fits import (
    SLOPE,
    Collapse,
    FormulaReading,
    LeakageLaw,
    SealingLaw,
    SkewedLaw,
    collapse,
    leakage_law,
    read_formulas,
    sealing_law,
    skewed_law,
)
from scripts.studies.paper_f.sizes import Sizes
from scripts.studies.paper_f.surfaces import HEIGHTS

DIRECTED, SKEWED = ("striated", "oblique"), ("peaky", "valley-rich", "plateau")
GROUPS: Mapping[str, Callable[[Pressed], bool]] = {
    "all": lambda _: True,
    "isotropic": lambda one: one.family not in DIRECTED,
    "isotropic, symmetric heights": lambda one: one.family not in DIRECTED + SKEWED,
}
"""Groups of the families."""


@dataclass(frozen=True, kw_only=True)
class GroupLaws:
    """Laws fitted to one group of surfaces.

    Attributes
    ----------
    sealing : by scale, the eight heights and the rms slope.
    skewed : with the skewness beside the slope.
    collapses : of leakage by the eight heights, as they are (""), and by a height with loads over the slope.
    leakage : of F.18's form: by Svm, as the source has it, and by Sp and the slope.
    readings : of F.17.
    """

    count: int
    sealing: Mapping[str, SealingLaw]
    skewed: SkewedLaw
    collapses: Sequence[Collapse]
    leakage: Mapping[tuple[str, str], LeakageLaw]
    readings: Sequence[FormulaReading]


@dataclass(frozen=True, kw_only=True)
class SealStudy:
    """Everything that is judged and drawn; ``measured`` is empty where the instrument files are absent.

    Attributes
    ----------
    sample : independent made surfaces.
    finer : the first of each family again on twice as many nodes a side.
    laws : by ``GROUPS``.
    """

    sample: Sequence[Pressed]
    finer: Sequence[Pressed]
    measured: Sequence[Pressed]
    sizes: Sizes
    laws: Mapping[str, GroupLaws]


def fit(sample: Sequence[Pressed]) -> GroupLaws:
    """Fit all laws of a group."""
    return GroupLaws(
        count=len(sample),
        sealing={name: sealing_law(sample, name) for name in (*HEIGHTS, SLOPE)},
        skewed=skewed_law(sample),
        collapses=[collapse(sample, name, name) for name in ("", *HEIGHTS)]
        + [collapse(sample, name, SLOPE) for name in ("Sq", "Sp", "Spm")],
        leakage={pair: leakage_law(sample, *pair) for pair in (("Svm", "Svm"), ("Sp", "Sp"), ("Sp", SLOPE))},
        readings=read_formulas(sample),
    )


def fit_groups(sample: Sequence[Pressed]) -> dict[str, GroupLaws]:
    """The laws of each group that has surfaces."""
    groups = {name: [one for one in sample if counts(one)] for name, counts in GROUPS.items()}
    return {name: fit(members) for name, members in groups.items() if members}
