"""A published number beside ours, and the source that it comes from."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from roughfilm.rom.ladder.model import Progress


class Verdict(StrEnum):
    """How a published number and ours agree."""

    WITHIN = "within"
    """They differ by at most the bar and the uncertainty, added in squares."""
    OUTSIDE = "outside"
    """They differ by more."""
    SUSPECT = "suspect"
    """They differ by more, and other published numbers, or a method without common code, contradict this one too."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One published number and ours.

    Attributes
    ----------
    case : what was solved, such as "B/D = 0.5, eccentricity 0.1".
    series : group of cases that a figure joins by a line.
    at : abscissa of the figure.
    quantity, unit : what is compared.
    published, ours : the values, in the unit.
    bar : accuracy of the published value, in the unit.
    uncertainty : that of ours, in the unit; None if it is unknown.
    evidence : what other published numbers, or a method without common code, give; "" if they do not contradict it.
    """

    case: str
    series: str
    at: float
    quantity: str
    unit: str
    published: float
    ours: float
    bar: float
    uncertainty: float | None = None
    evidence: str = ""

    @property
    def difference(self) -> float:
        """Ours minus the published value, in the unit."""
        return self.ours - self.published

    @property
    def relative(self) -> float | None:
        """The difference over the published value; None where that is below its bar."""
        return self.difference / abs(self.published) if abs(self.published) > self.bar else None

    @property
    def allowed(self) -> float:
        """The bar and the uncertainty, added in squares, in the unit."""
        return math.hypot(self.bar, self.uncertainty or 0.0)

    @property
    def verdict(self) -> Verdict:
        """Whether the difference is within what is allowed."""
        if abs(self.difference) <= self.allowed:
            return Verdict.WITHIN
        return Verdict.SUSPECT if self.evidence else Verdict.OUTSIDE


def against_closed_form(
    case: str, at: float, compared: Sequence[tuple[str, str, float, float, float]], bar: float
) -> list[Row]:
    """The rows of a case whose values a closed form gives.

    Parameters
    ----------
    case, at : name of the case, and its abscissa.
    compared : for each quantity its name, its unit, and in that unit the closed form, our value and its uncertainty.
    bar : relative accuracy that is asked of our values.
    """
    return [
        Row(
            case=case,
            series="closed form",
            at=at,
            quantity=quantity,
            unit=unit,
            published=exact,
            ours=ours,
            uncertainty=uncertainty,
            bar=bar * abs(exact),
        )
        for quantity, unit, exact, ours, uncertainty in compared
    ]


@dataclass(frozen=True, kw_only=True)
class Study:
    """A table that supports a conclusion.

    Attributes
    ----------
    title : one line.
    columns : their names with units.
    cells : the rows, as text.
    """

    title: str
    columns: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A published curve and ours.

    Attributes
    ----------
    title, abscissa, ordinate : labels, with units.
    x, ours : our points.
    published_x, published : the published points.
    logarithmic : whether the abscissa is.
    """

    title: str
    abscissa: str
    ordinate: str
    x: tuple[float, ...]
    ours: tuple[float, ...]
    published_x: tuple[float, ...]
    published: tuple[float, ...]
    logarithmic: bool = False


@dataclass(frozen=True, kw_only=True)
class Answer:
    """The rows of a source, with sentences and studies that explain them, and curves that replace their figure."""

    rows: tuple[Row, ...]
    remarks: tuple[str, ...] = ()
    studies: tuple[Study, ...] = ()
    curves: tuple[Curve, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Source:
    """A published source that the code answers.

    Attributes
    ----------
    name : short name, that of the module.
    title : what it is, in a line.
    citation : the publication.
    obtained : how its numbers were had.
    methods : which model answers, at which resolution, by default and with the finest grids.
    bar : accuracy of the numbers, in words.
    abscissa : label of the abscissa of the figure.
    cost : expected CPU time, s, by default and with the finest grids.
    answer : answer(thorough, progress), with the finest grids if ``thorough``.
    """

    name: str
    title: str
    citation: str
    obtained: str
    methods: tuple[str, str]
    bar: str
    abscissa: str
    cost: tuple[float, float]
    answer: Callable[[bool, Progress], Answer]
