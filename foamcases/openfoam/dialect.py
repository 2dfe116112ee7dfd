"""The two families of OpenFOAM, what their dictionaries call the same thing, and which release is which."""

import math
import re
from dataclasses import dataclass
from typing import Literal

from roughfilm.contact.foundation.errors import InputError

Family = Literal["com", "org"]
"""openfoam.com (OpenCFD: v1912, v2412, ...) or openfoam.org (the OpenFOAM Foundation: 7, 13, dev, ...)."""


@dataclass(frozen=True, kw_only=True)
class Dialect:
    """The words of dictionaries that differ between the families of OpenFOAM.

    All other entries are written in each spelling, because OpenFOAM ignores entries that it does not read.

    Attributes
    ----------
    name : name of the dialect.
    releases : the releases that read it, in words.
    source : type of a source of momentum in ``fvOptions``.
    stop : type of the function that ends a run when a file appears.
    amplification : largest correction of velocity by pressure in SIMPLEC, over that of SIMPLE.
    """

    name: Family
    releases: str
    source: str
    stop: str
    amplification: float

    @property
    def refusal(self) -> str:
        """The line for a case of this dialect that runs with an OpenFOAM that reads the other."""
        other = ORG if self.name == "com" else COM
        return (
            f"this case is for {self.releases}; the OpenFOAM here is of {other.releases}: "
            f"generate it with --dialect {other.name}"
        )

    def pressure_relaxation(self, velocity_relaxation: float) -> float:
        """The relaxation of pressure in SIMPLEC at a relaxation a of velocity: min(1, amplification (1 - a)).

        SIMPLEC corrects velocity 1/(1 - a) times as much as SIMPLE. A solver that corrects it less finds a pressure
        that is too large by the same factor, and diverges above a factor of 2. The relaxation of pressure takes that
        back.
        """
        return min(1.0, self.amplification * (1 - velocity_relaxation))


COM = Dialect(
    name="com",
    releases="openfoam.com, or openfoam.org 7",
    source="vectorSemiImplicitSource",
    stop="abort",
    amplification=math.inf,
)
ORG = Dialect(
    name="org",
    releases="openfoam.org 8 or later",
    source="semiImplicitSource",
    stop="stopAtFile",
    amplification=10.0,  # from release 11 on; the others only need more iterations
)
DIALECTS = {dialect.name: dialect for dialect in (COM, ORG)}


def dialect_named(name: str) -> Dialect:
    """The dialect of a name; InputError for another word."""
    found = next((dialect for dialect in DIALECTS.values() if dialect.name == name), None)
    if found is None:
        known = " or ".join(f"{one.name} ({one.releases})" for one in DIALECTS.values())
        raise InputError(f"dialect: got {name!r}; it must be {known}")
    return found


TRIED: frozenset[tuple[Family, str]] = frozenset({("com", "1912"), ("org", "13")})
"""Families and numbers of the releases with which the tests of this project have passed."""

BANNER = re.compile(
    r"Using: OpenFOAM-(\S*) \((?:(\d{4})\) - visit www\.openfoam\.com|see https?://(?:www\.)?openfoam\.org\))"
)
"""The line by which a program of OpenFOAM states its release; the number in brackets is that of openfoam.com."""


@dataclass(frozen=True, kw_only=True)
class Release:
    """A release of OpenFOAM.

    Attributes
    ----------
    family : the family.
    number : "2412" of openfoam.com's v2412, "13" or "dev" of openfoam.org.
    """

    family: Family
    number: str

    @property
    def dialect(self) -> Dialect:
        """The dialect that the release reads."""
        return COM if self.family == "com" or self.number == "7" else ORG

    @property
    def tried(self) -> bool:
        """Whether the tests of this project have passed with the release."""
        return (self.family, self.number) in TRIED

    @property
    def caution(self) -> str:
        """A sentence on a release that was never tried, and "" for the others."""
        if self.tried:
            return ""
        known = " and ".join(sorted(str(Release(family=family, number=number)) for family, number in TRIED))
        return f"{self} was never tried with roughfilm, {known} were; compare a result with another model's"

    def __str__(self) -> str:
        return f"OpenFOAM v{self.number}" if self.family == "com" else f"OpenFOAM {self.number} of openfoam.org"


def release_in(text: str) -> Release | None:
    """The release that a program of OpenFOAM states in its help or log; None if it states none.

    Examples
    --------
    >>> str(release_in("Using: OpenFOAM-v2412 (2412) - visit www.openfoam.com"))
    'OpenFOAM v2412'
    >>> str(release_in("Using: OpenFOAM-13 (see https://openfoam.org)"))
    'OpenFOAM 13 of openfoam.org'
    """
    banner = BANNER.search(text)
    if banner is None:
        return None
    if banner[2]:
        return Release(family="com", number=banner[2])
    return Release(family="org", number=banner[1].partition("-")[0])
