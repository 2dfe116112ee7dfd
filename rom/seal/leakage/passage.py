"""Permeability of a gap by direction, and the leakage of a seal."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Passage:
    """Flow through a gap in one direction.

    Attributes
    ----------
    permeability : K = 12η Q L/Δp, m³, for the flow Q per width at a pressure drop Δp over the length L; h³ for a smooth
        gap, and exactly 0 if sealed.
    uncertainty : uncertainty of K from the grid and the solver, m³; above 0 if a sealed gap is open on coarser grids.
    sealed : whether there is no open path through the gap.
    corrector : deviation ψ of the pressure p = Δp (1 − (x + ψ)/L) from a linear one, m, shape (nx, ny), 0 if sealed;
        an argument of :func:`roughfilm.rom.homogenization.flux.flux`.
    unsolved : relative solver error of K.
    iterations : conjugate-gradient iterations on the finest grid.
    residual : recomputed residual over the right-hand side; it may be large where the flow is negligible.
    """

    permeability: float
    uncertainty: float
    sealed: bool
    corrector: Array
    unsolved: float
    iterations: int
    residual: float


@dataclass(frozen=True, kw_only=True)
class Leakage:
    """Flow through a gap in x (``along``) and in y (``across``)."""

    along: Passage
    across: Passage

    @property
    def permeability(self) -> Array:
        """The permeability in x and y, shape (2,), m³."""
        return np.array([self.along.permeability, self.across.permeability])

    @property
    def uncertainty(self) -> Array:
        """The uncertainty of the permeability, shape (2,), m³."""
        return np.array([self.along.uncertainty, self.across.uncertainty])

    @property
    def sealed(self) -> tuple[bool, bool]:
        """Whether the gap is sealed in x, and in y."""
        return self.along.sealed, self.across.sealed


def shut(shape: tuple[int, ...]) -> Passage:
    """The zero flow through a gap of a given shape that is closed everywhere."""
    return Passage(
        permeability=0.0,
        uncertainty=0.0,
        sealed=True,
        corrector=np.zeros(shape),
        unsolved=0.0,
        iterations=0,
        residual=0.0,
    )


def mass_flow(permeability: float, *, density: float, viscosity: float, pressure_drop: float, length: float) -> float:
    """The leakage per width ρ K Δp/(12 η L) of an incompressible liquid, kg/(s m).

    Parameters
    ----------
    permeability : K, m³.
    density : ρ, kg/m³.
    viscosity : η, Pa s.
    pressure_drop : Δp, Pa.
    length : L along the flow, m.

    Source: Sahlin 2008, F.11 and F.12.
    """
    return density * permeability * pressure_drop / (12 * viscosity * length)


def dimensionless(permeability: float, height: float) -> float:
    """The dimensionless leakage Q̃ = 12 η Q/(h_r³ p_r) = K/h_r³ of a square, 1 for a smooth gap of the height h_r, m.

    Source: Sahlin 2008, F.13.
    """
    return permeability / height**3
