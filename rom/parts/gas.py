"""Gases that a scene takes as liquids, and how much their compressibility changes."""

import math

GAS_BELOW = 50.0
"""Density below which a fluid is a gas, kg/m³: the lightest liquid, hydrogen, has 71."""

THIN_AS_GAS = 5e-5
"""Viscosity below which a fluid without a density counts as a gas, Pa s: gases have 0.7e-5 to 4e-5, water 3e-4."""

NEGLIGIBLE = 1e-3
"""Change of the density of a gas that does not count."""


def is_gas(density: float | None, viscosity: float) -> bool:
    """Whether a fluid with this density, kg/m³ (None if it is unknown), and viscosity, Pa s, is a gas."""
    return viscosity < THIN_AS_GAS if density is None else density < GAS_BELOW


def compressibility_of_gas(
    density: float | None, viscosity: float, pressure: float, ambient: float, number: float = math.nan
) -> tuple[str, ...]:
    """The sentence on a gas of constant density; none for a liquid, and where the density hardly changes.

    The density of an isothermal ideal gas changes by the part p/p_a where the pressure p differs from ambient, and
    flows and loads change by a part of the same order, as the first two terms of an expansion in the compressibility
    number Λ = 6ηuL/(p_a h²) show.

    Parameters
    ----------
    density, viscosity : those of the fluid, kg/m³ (None if it is unknown) and Pa s.
    pressure : largest difference of the pressure of the film from ambient, Pa.
    ambient : ambient pressure p_a, absolute, Pa.
    number : compressibility number; NaN where nothing slides.

    Source: Gross 1962, Gas Film Lubrication, chapter 2.
    """
    change = pressure / ambient
    if not is_gas(density, viscosity) or change <= NEGLIGIBLE:
        return ()
    known = f"a viscosity of {viscosity:.3g} Pa s" if density is None else f"a density of {density:.3g} kg/m³"
    of_sliding = "" if math.isnan(number) else f"Λ = 6ηuL/(p_a h²) = {number:.3g}, and "
    return (
        f"the lubricant is a gas ({known}) that is taken as incompressible: {of_sliding}pressures differ from ambient "
        f"by {change:.2g} p_a, above {NEGLIGIBLE:g}, which changes density, flow and load by about this part; give "
        "lubricant.compressibility",
    )


def leakage_of_gas(density: float, viscosity: float, drop: float, ambient: float) -> tuple[str, ...]:
    """The sentence on the leakage of a gas that is taken as a liquid; none for a liquid, and for a small pressure drop.

    The density of an isothermal ideal gas falls along its path, and its mass flow is ρ K (p₁² - p₂²)/(2 η L p₂) with
    the density ρ at the outlet: 1 + Δp/(2 p₂) times that of a liquid of this density.

    Parameters
    ----------
    density, viscosity : those of the fluid, kg/m³ and Pa s.
    drop : pressure drop Δp, Pa.
    ambient : absolute pressure p₂ at the outlet, Pa.
    """
    change = drop / (2 * ambient)
    if not is_gas(density, viscosity) or change <= NEGLIGIBLE:
        return ()
    return (
        f"the liquid is a gas (a density of {density:.3g} kg/m³) that is taken as incompressible: the pressure drop is "
        f"{drop / ambient:.3g} times the ambient pressure, and an ideal gas with this density at the outlet leaks "
        f"{1 + change:.4g} times as much, with this density at the inlet {(1 + change) / (1 + 2 * change):.4g} times",
    )
