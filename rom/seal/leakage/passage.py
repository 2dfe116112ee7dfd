"""What a gap lets through: permeability by direction, and what that is in a seal."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Passage:
    """Through a gap in one direction.

    Attributes
    ----------
    permeability : K = 12η Q L/Δp, m³, of the flow Q per width at a pressure drop Δp over the length L: h³ of a smooth
        gap; exactly 0 where it is sealed.
    uncertainty : m³, of its grid and its solver.
    sealed : whether no open path leads through.
    corrector : m, shape (nx, ny): pressure is linear but for it, p = Δp (1 − (x + ψ)/L); 0 if sealed.
        :func:`roughfilm.rom.homogenization.flux.flux` takes it.
    unsolved : the part of K by which iterating on would change it.
    iterations : of conjugate gradients on the finest grid.
    residual : recomputed, over the right-hand side; it may be far larger where next to nothing flows.
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
    """Through a gap in x (``along``) and in y (``across``)."""

    along: Passage
    across: Passage

    @property
    def permeability(self) -> Array:
        """Shape (2,), m³."""
        return np.array([self.along.permeability, self.across.permeability])

    @property
    def uncertainty(self) -> Array:
        """Shape (2,), m³."""
        return np.array([self.along.uncertainty, self.across.uncertainty])

    @property
    def sealed(self) -> tuple[bool, bool]:
        """In x, in y."""
        return self.along.sealed, self.across.sealed


def shut(shape: tuple[int, ...]) -> Passage:
    """Of a gap that is closed everywhere."""
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
    """ρ K Δp/(12 η L), kg/(s m): what leaks for each metre of a seal's width, of a liquid that does not compress.

    Parameters
    ----------
    permeability : K, m³.
    density, viscosity : ρ, kg/m³, and η, Pa s.
    pressure_drop, length : Δp, Pa, over L, m, along the flow.

    Source: Sahlin 2008, F.11 and F.12.
    """
    return density * permeability * pressure_drop / (12 * viscosity * length)


def dimensionless(permeability: float, height: float) -> float:
    """Q̃ = 12 η Q/(h_r³ p_r) of a square, which is K/h_r³: 1 of a smooth gap as thick as the height h_r, m.

    Source: Sahlin 2008, F.13.
    """
    return permeability / height**3
