"""The kinematic viscosity over temperature by ASTM D341: through two points, or of an ISO viscosity grade."""

import math
from functools import cached_property
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from pydantic import BeforeValidator, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, plain_number
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.lubricants.thermal.index import LEAST_HOT, MOST_INDEX, kinematic_viscosity_100
from roughfilm.rom.lubricants.thermal.law import LOG_LIMIT, ZERO_CELSIUS, AbsoluteLaw, Temperature
from roughfilm.rom.lubricants.thermal.viscosity import check_points

KinematicViscosity = Annotated[float, InUnit("m^2/s")]
KinematicPoint = tuple[Temperature, KinematicViscosity]

MM2 = 1e-6
"""1 mm²/s in m²/s."""

WALTHER_VISCOSITIES = (0.21, 2e7)
"""Kinematic viscosities for which the equation of ASTM D341 is given, mm²/s."""

WALTHER_TEMPERATURES = (203.15, 643.15)
"""Temperatures of the charts of ASTM D341, -70 to 370 °C, in K."""

GRADES = {2: 2.2, 3: 3.2, 5: 4.6, 7: 6.8} | {
    grade: float(grade) for grade in (10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)
}
"""Midpoint of each viscosity grade of ISO 3448, mm²/s at 40 °C; the grade spans 10 % to both sides."""

POUR_AND_FLASH = {
    7: (-30, 115),
    10: (-30, 125),
    15: (-24, 140),
    22: (-21, 165),
    32: (-18, 175),
    46: (-15, 185),
    68: (-12, 195),
    100: (-12, 205),
    150: (-12, 215),
    **dict.fromkeys((220, 320, 460), (-9, 200)),
    **dict.fromkeys((680, 1000), (-3, 200)),
    **dict.fromkeys((1500, 2200, 3200), (0, 200)),
}
"""Pour and flash points of mineral oils by their grade, °C: the highest and the lowest that DIN 51524-2 permits up to
ISO VG 150 and DIN 51517-3 up to 1000, rounded; typical ones of the others. Between them an oil is a liquid whose vapour
does not burn. Turbine oils of JIS K 2213 (VG 32) may pour up to -10 °C, and flash above 190 °C."""

MAX_STEPS = 20
"""Largest number of steps in which a viscosity is sought; five are enough in the range of the law."""

FORTY, HUNDRED = 313.15, 373.15


def _excess(viscosity: Array) -> tuple[Array, Array]:
    """Z - ν and its derivative over ν, both in mm²/s."""
    correction = np.exp(-1.47 - 1.84 * viscosity - 0.51 * viscosity**2)
    return 0.7 + correction, -(1.84 + 1.02 * viscosity) * correction


def _kinematic(z: Array) -> Array:
    """The kinematic viscosity ν of Z > 0.93, both in mm²/s, by Newton's method."""
    viscosity = np.maximum(z - 0.7, 0.05)
    for _ in range(MAX_STEPS):
        excess, slope = _excess(viscosity)
        before, viscosity = viscosity, np.maximum(viscosity - (viscosity + excess - z) / (1 + slope), 1e-3)
        if (np.abs(viscosity - before) <= 1e-8 * viscosity).all():  # the next step would be of rounding
            break
    return viscosity


class Walther(AbsoluteLaw):
    """The law ln ln Z = A - B ln T through two points, Z = ν + 0.7 + exp(-1.47 - 1.84 ν - 0.51 ν²), ν in mm²/s.

    For oils of ν = 0.21 mm²/s and more, -70 to 370 °C. Source: ASTM D341; Walther 1931.

    Attributes
    ----------
    points : two rows of temperature and kinematic viscosity.
    valid_from, valid_to : temperatures between which the law is valid, K; by default by both ranges above.

    Examples
    --------
    >>> points = [["40 degC", "32 mm^2/s"], ["100 degC", "5.4 mm^2/s"]]
    >>> law = Walther.model_validate({"law": "walther", "points": points})
    >>> print(f"{1e6 * law.viscosity(np.array([353.15]))[0][0]:.2f} mm²/s at 80 °C")
    8.53 mm²/s at 80 °C
    """

    kinematic: ClassVar[bool] = True
    law: Literal["walther"]
    points: tuple[KinematicPoint, KinematicPoint]
    valid_from: Temperature | None = None
    valid_to: Temperature | None = None

    @model_validator(mode="after")
    def _falls(self) -> Self:
        check_points("points", self.points, "m²/s")
        lowest = min(viscosity for _, viscosity in self.points) / MM2
        if lowest < WALTHER_VISCOSITIES[0]:
            raise ValueError(
                f"points: got {lowest:.4g} mm^2/s; the law needs at least {WALTHER_VISCOSITIES[0]} mm^2/s, take "
                "vogel or tabulated"
            )
        return self

    @cached_property
    def constants(self) -> tuple[float, float]:
        """The constants A and B, with natural logarithms."""
        (cold, thick), (hot, thin) = (
            (math.log(t), math.log(math.log(float(v / MM2 + _excess(np.array(v / MM2))[0])))) for t, v in self.points
        )
        b = (thick - thin) / (hot - cold)
        return thick + b * cold, b

    def _temperature(self, z: float) -> float:
        a, b = self.constants
        return math.exp((a - math.log(math.log(z))) / b)

    @property
    def coldest(self) -> float:
        """The temperature up to which the law has no viscosity, K."""
        return self._temperature(math.exp(LOG_LIMIT))

    def valid(self) -> tuple[float, float]:
        """The lowest and the highest valid temperature, K, given or by both ranges of ASTM D341."""
        thinnest, thickest = (one + float(_excess(np.array(one))[0]) for one in WALTHER_VISCOSITIES)
        low, high = WALTHER_TEMPERATURES
        return self.narrowed(max(low, self._temperature(thickest)), min(high, self._temperature(thinnest)))

    def viscosity(self, temperature: Array) -> tuple[Array, Array]:
        """The kinematic viscosity ν, m²/s, and dν/dT; shape of ``temperature``, K; InputError if it is too low."""
        self.refuse_below(self.coldest, temperature)
        a, b = self.constants
        log_z = np.exp(a - b * np.log(temperature))
        z = np.exp(log_z)
        viscosity = _kinematic(z)
        return viscosity * MM2, -MM2 * z * log_z * b / (temperature * (1 + _excess(viscosity)[1]))


class IsoGrade(AbsoluteLaw):
    """The viscosity of an oil of an ISO viscosity grade: Walther's law through 40 and 100 °C.

    The kinematic viscosity at 40 °C is the midpoint of the grade (ISO 3448, ±10 %); that at 100 °C is the one of which
    the viscosity index follows (ASTM D2270, ISO 2909). Grades 2, 3 and 5 are thinner than 2 mm²/s at 100 °C, where no
    index is defined.

    Attributes
    ----------
    grade : viscosity grade, such as 32 of ISO VG 32.
    viscosity_index : viscosity index, 95 by default, that of a solvent-refined mineral oil.
    valid_from, valid_to : temperatures between which the law is valid, K; by default from the pour point to the flash
        point of mineral oils of the grade (``POUR_AND_FLASH``).

    Examples
    --------
    >>> law = IsoGrade.model_validate({"law": "iso_vg", "grade": 46})
    >>> print(*(f"{1e6 * one:.4g} mm²/s" for one in law.viscosity(np.array([313.15, 373.15]))[0]))
    46 mm²/s 6.644 mm²/s
    """

    ends: ClassVar[str] = ", pour and flash point of such oils"
    kinematic: ClassVar[bool] = True
    law: Literal["iso_vg"]
    grade: int
    viscosity_index: Annotated[float, BeforeValidator(plain_number)] = 95.0
    valid_from: Temperature | None = None
    valid_to: Temperature | None = None

    @model_validator(mode="after")
    def _exists(self) -> Self:
        if self.grade not in GRADES:
            raise ValueError(f"grade: got {self.grade}; it must be one of {', '.join(map(str, GRADES))}")
        if not 0 <= self.viscosity_index <= MOST_INDEX:
            raise ValueError(f"viscosity_index: got {self.viscosity_index:g}; it must be 0 to {MOST_INDEX:g}")
        if kinematic_viscosity_100(GRADES[self.grade], self.viscosity_index) is None:
            raise ValueError(
                f"grade: got {self.grade} with the viscosity index {self.viscosity_index:g}, which is not defined "
                f"below {LEAST_HOT:g} mm^2/s at 100 °C; take walther with two points"
            )
        return self

    @cached_property
    def walther(self) -> Walther:
        """Walther's law through both points."""
        hot = kinematic_viscosity_100(GRADES[self.grade], self.viscosity_index)
        assert hot is not None
        points = [
            (with_unit(temperature, "K"), with_unit(viscosity * MM2, "m^2/s"))
            for temperature, viscosity in ((FORTY, GRADES[self.grade]), (HUNDRED, hot))
        ]
        return Walther.model_validate({"law": "walther", "points": points})

    def valid(self) -> tuple[float, float]:
        """The lowest and the highest valid temperature, K."""
        pour, flash = POUR_AND_FLASH[self.grade]
        return self.narrowed(pour + ZERO_CELSIUS, flash + ZERO_CELSIUS)

    def viscosity(self, temperature: Array) -> tuple[Array, Array]:
        """The kinematic viscosity ν, m²/s, and dν/dT; shape of ``temperature``, K; InputError if it is too low."""
        self.refuse_below(self.walther.coldest, temperature)
        return self.walther.viscosity(temperature)
