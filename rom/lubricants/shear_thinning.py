"""Laws of shear thinning: the viscosity of a lubricant over the shear rate and the shear stress.

A law has the viscosity η₀ at rest, that of the local temperature and pressure, and one critical stress τ_c:

    η = η₀ f(G),    G = η₀ γ̇/τ_c,

so that all isotherms and isobars are one curve of G (time-temperature-pressure superposition): the time λ = τ_c/η₀
falls with the temperature as the viscosity at rest does, and τ_c does not change. The shear stress is
τ = τ_c S with S = G f(G), which grows with G, and the shear rate of a stress is γ̇ = φ(S) τ/η₀ with the relative
fluidity φ = 1/f. Source: Bair 2007, High Pressure Rheology for Quantitative Elastohydrodynamics, chapters 6 and 8.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import AfterValidator, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import InUnit, Part, PositiveNumber

Stress = Annotated[float, InUnit("Pa")]
Time = Annotated[float, InUnit("s")]
Viscosity = Annotated[float, InUnit("Pa*s")]

LEAST_INDEX = 0.1
"""Smallest power-law index."""

EXPONENTS = (0.2, 4.0)
"""Smallest and largest exponent of Yasuda."""

SPACING = 1 / 128
"""Spacing of a curve in ln S: the relative error of φ is below 1e-9."""

BEGINS = 1e-17
"""Relative change of the viscosity at which a curve begins."""

MOST_FLUIDITY = 250.0
"""Largest ln φ of a curve."""

MOST_STRESS = 40.0
"""Largest ln S of a curve."""

STEPS = 200
"""Largest number of Newton steps for the shear rate of a stress."""

ROUND_OFF = 1e-15
"""Relative change of ln G at which these steps end."""


@dataclass(frozen=True, eq=False)
class ThinningCurve:
    """The relative fluidity φ = η₀/η over the relative stress S, as cubics of ln φ over ln S.

    Below its first point φ is 1; beyond the last one ln φ is linear in ln S.

    Attributes
    ----------
    stress : critical stress τ_c, Pa.
    begin : ln S at the first point.
    values, slopes : ln φ and d ln φ/d ln S at points ``SPACING`` apart.
    relative_stress : S of numbers G = η₀ γ̇/τ_c, of their shape.
    """

    stress: float
    begin: float
    values: Array
    slopes: Array
    relative_stress: Callable[[Array], Array]

    def fluidity(self, relative: Array) -> tuple[Array, Array]:
        """φ and d ln φ/d ln S at S >= 0, of the shape of ``relative``."""
        with np.errstate(divide="ignore"):
            place = (np.log(relative) - self.begin) / SPACING
        cell = np.clip(np.nan_to_num(place, neginf=0.0), 0, self.values.size - 2).astype(int)
        t = np.clip(place - cell, 0.0, 1.0)
        left, right = self.values[cell], self.values[cell + 1]
        rise, fall = SPACING * self.slopes[cell], SPACING * self.slopes[cell + 1]
        square, cube = 3 * (right - left) - 2 * rise - fall, rise + fall - 2 * (right - left)
        value = left + t * (rise + t * (square + t * cube))
        slope = (rise + t * (2 * square + 3 * t * cube)) / SPACING
        beyond = np.maximum(place - (self.values.size - 1), 0.0)
        value += self.slopes[-1] * SPACING * beyond
        return np.exp(np.minimum(value, 2 * MOST_FLUIDITY)), np.where(place < 0, 0.0, slope)


class ThinningLaw(Part):
    """A law of shear thinning; ``viscosity`` is the viscosity η₀ at rest, Pa s, at the supply temperature."""

    def critical_stress_of(self, viscosity: float) -> float:
        """The critical stress τ_c, Pa."""
        raise NotImplementedError

    def relative(self, shear: Array, viscosity: float) -> tuple[Array, Array]:
        """The ratio f = η/η₀ and d ln f/d ln G at numbers G >= 0, each of their shape."""
        raise NotImplementedError

    def first_stress(self, viscosity: float) -> float:
        """A relative stress S below which 1 - f is below ``BEGINS``."""
        raise NotImplementedError

    def viscosity_at(self, rate: Array, viscosity: float) -> Array:
        """The viscosity η, Pa s, at shear rates γ̇ >= 0, 1/s, and the supply temperature; of their shape."""
        shear = viscosity * np.asarray(rate) / self.critical_stress_of(viscosity)
        return np.asarray(viscosity * self.relative(shear, viscosity)[0])

    def check(self, viscosity: float) -> None:
        """Raise ValueError if the law does not thin a lubricant of the viscosity η₀, Pa s."""

    def scaled(self, ratio: float) -> Self:  # noqa: ARG002
        """The same law where the viscosity at rest has changed by a ratio, such as at another temperature."""
        return self

    def curve(self, viscosity: float) -> ThinningCurve:
        """The relative fluidity over the relative stress, of the law with the viscosity η₀, Pa s."""
        return _curve(self, viscosity)


class CarreauYasuda(ThinningLaw):
    """The law η = η∞ + (η₀ - η∞) (1 + (λ γ̇)^a)^((n - 1)/a), which is that of Carreau with a = 2.

    The time λ is τ_c/η₀, and its inverse the critical shear rate. η∞ keeps its ratio to η₀ as the temperature changes.
    The law holds over the shear rates at which it was fitted. Sources: Carreau 1972, doi:10.1122/1.549276; Yasuda,
    Armstrong and Cohen 1981, doi:10.1007/BF01513059.

    Attributes
    ----------
    index : power-law index n, 0.1 to 1.
    critical_stress : critical stress τ_c = η₀/λ, Pa.
    relaxation_time : time λ at the supply temperature and the cavitation pressure, s, in place of the critical stress.
    exponent : exponent a of Yasuda, 0.2 to 4.
    infinite_shear_viscosity : viscosity η∞ at an infinite shear rate, Pa s, at the supply temperature; by default 0.
    """

    law: Literal["carreau_yasuda"]
    index: Annotated[PositiveNumber, AfterValidator(lambda n: _between(n, LEAST_INDEX, 1.0))]
    critical_stress: Stress | None = None
    relaxation_time: Time | None = None
    exponent: Annotated[PositiveNumber, AfterValidator(lambda a: _between(a, *EXPONENTS))] = 2.0
    infinite_shear_viscosity: Viscosity | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.critical_stress is None) == (self.relaxation_time is None):
            got = "neither" if self.critical_stress is None else "both"
            raise ValueError(f"got {got} of critical_stress and relaxation_time; give one of them")
        return self

    def critical_stress_of(self, viscosity: float) -> float:
        """The critical stress τ_c, Pa."""
        if self.critical_stress is not None:
            return self.critical_stress
        assert self.relaxation_time is not None
        return viscosity / self.relaxation_time

    def check(self, viscosity: float) -> None:
        """Raise ValueError if η∞ is not below the viscosity η₀, Pa s."""
        least = self.infinite_shear_viscosity
        if least is not None and least >= viscosity:
            raise ValueError(
                f"lubricant.shear_thinning.infinite_shear_viscosity: got {least:.6g} Pa s; it must be below "
                f"lubricant.viscosity, {viscosity:.6g} Pa s"
            )

    def scaled(self, ratio: float) -> Self:
        """The same law where the viscosity at rest has changed by a ratio, such as at another temperature."""
        given = {"relaxation_time": self.relaxation_time, "infinite_shear_viscosity": self.infinite_shear_viscosity}
        return self.model_copy(update={name: one * ratio for name, one in given.items() if one is not None})

    def relative(self, shear: Array, viscosity: float) -> tuple[Array, Array]:
        """The ratio f = η/η₀ and d ln f/d ln G at numbers G >= 0, each of their shape."""
        least = (self.infinite_shear_viscosity or 0.0) / viscosity
        with np.errstate(over="ignore", divide="ignore"):
            power = self.exponent * np.log(np.asarray(shear))
        base = np.logaddexp(0.0, power)
        thinned = (1 - least) * np.exp((self.index - 1) / self.exponent * base)
        f = least + thinned
        return f, (self.index - 1) * np.exp(power - base) * thinned / f

    def first_stress(self, viscosity: float) -> float:  # noqa: ARG002
        """A relative stress S below which 1 - f is below ``BEGINS``."""
        return float((BEGINS * self.exponent) ** (1 / self.exponent))


class ReeEyring(ThinningLaw):
    """The law γ̇ = (τ₀/η₀) sinh(τ/τ₀) with the Eyring stress τ₀.

    Measured on oils at 0.1 GPa and above, where τ₀ is about 2 to 10 MPa; it describes friction there better than the
    viscosity of dilute polymers. Source: Johnson and Tevaarwerk 1977, doi:10.1098/rspa.1977.0129.

    Attributes
    ----------
    critical_stress : Eyring stress τ₀, Pa.
    """

    law: Literal["ree_eyring"]
    critical_stress: Stress

    def critical_stress_of(self, viscosity: float) -> float:  # noqa: ARG002
        """The Eyring stress τ₀, Pa."""
        return self.critical_stress

    def relative(self, shear: Array, viscosity: float) -> tuple[Array, Array]:  # noqa: ARG002
        """The ratio f = η/η₀ = arsinh(G)/G and d ln f/d ln G at numbers G >= 0, each of their shape."""
        shear = np.asarray(shear, dtype=float)
        small = shear < 1e-4
        at = np.where(small, 1.0, shear)
        stress = np.arcsinh(at)
        f = np.where(small, 1 - shear**2 / 6, stress / at)
        return f, np.where(small, -(shear**2) / 3, at / np.hypot(1.0, at) / stress - 1)

    def first_stress(self, viscosity: float) -> float:  # noqa: ARG002
        """A relative stress S below which 1 - f is below ``BEGINS``."""
        return math.sqrt(6 * BEGINS)


def _between(number: float, least: float, most: float) -> float:
    if not least <= number <= most:
        raise ValueError(f"got {number!r}; it must be {least:g} to {most:g}")
    return number


@lru_cache(maxsize=32)
def _curve(law: ThinningLaw, viscosity: float) -> ThinningCurve:
    """The curve of a law: G of each S by Newton's method on ln S = ln G + ln f(G), whose slope is positive."""
    begin = math.log(law.first_stress(viscosity))
    wanted = np.arange(begin, MOST_STRESS, SPACING)
    place = wanted.copy()
    for _ in range(STEPS):
        f, slope = law.relative(np.exp(place), viscosity)
        change = (wanted - place - np.log(f)) / (1 + slope)
        place = np.minimum(place + change, wanted + MOST_FLUIDITY + 1)
        if np.abs(change).max() <= ROUND_OFF * np.abs(place).max():
            break
    f, slope = law.relative(np.exp(place), viscosity)
    values, slopes = -np.log(f), 1 / (1 + slope) - 1
    count = int(np.searchsorted(values, MOST_FLUIDITY))
    return ThinningCurve(
        stress=law.critical_stress_of(viscosity),
        begin=begin,
        values=np.ascontiguousarray(values[:count]),
        slopes=np.ascontiguousarray(slopes[:count]),
        relative_stress=lambda shear: shear * law.relative(shear, viscosity)[0],
    )


ShearThinning = CarreauYasuda | ReeEyring
THINNING_LAWS: dict[str, type[Part]] = {"carreau_yasuda": CarreauYasuda, "ree_eyring": ReeEyring}
