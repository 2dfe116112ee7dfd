"""Flow with a small offset added to the gap, against closed contact, until the gap is sealed."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.flow_factors import flow_factors
from scripts.studies.lay.data import POINTS, SIDE, gap_at

OFFSET = 1e-8
"""m, of the source."""

MADE = {"self-affine, Sq 2 µm": 2e-6, "self-affine, Sq 0.2 µm": 2e-7}
"""rms heights, m: about that of the source's specimens, and of a ground face."""

SEPARATIONS = (3.0, 2.5, 2.0, 1.5, 1.25, 1.0, 0.75, 0.5, 0.25, 0.0, -0.25, -0.5)
"""Over Sq."""


@dataclass(frozen=True, kw_only=True)
class Offset:
    """A separation: diagonals of A, m³, with closed contact and with the offset; nan where the solver failed.

    Attributes
    ----------
    separation : over Sq.
    relative : A₁₁ and A₂₂ of closed contact over ĥ³.
    contact : part of the nodes.
    """

    separation: float
    contact: float
    closed: Array
    offset: Array
    relative: Array

    @property
    def added(self) -> Array:
        """Relative increase of A₁₁ and A₂₂ by the offset; inf where these are 0."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.closed > 0, self.offset / self.closed - 1, np.inf)

    @property
    def slit(self) -> Array:
        """Height of the smooth slit with the same leakage as the gap with the offset, m."""
        return np.asarray(np.cbrt(self.offset))


def offset_all(
    prepared: Mapping[str, Prepared],
    advance: Callable[[str], None],
    *,
    points: int = POINTS,
    coarser: int = 1,
) -> dict[str, list[Offset]]:
    """Made and measured surfaces over all separations, or every so many; ``advance`` is called for each surface."""
    surfaces = {name: _made(roughness, points) for name, roughness in MADE.items()}
    surfaces |= {name: one.surface for name, one in prepared.items()}
    found = {}
    for name, surface in surfaces.items():
        advance(name)
        heights = surface.heights - surface.heights.mean()
        found[name] = [
            at(gap_at(heights, one * float(heights.std())), surface.spacing, separation=one)
            for one in SEPARATIONS[::coarser]
        ]
    return found


def at(gap: Array, spacing: tuple[float, float], *, separation: float) -> Offset:
    """Return the flow through one gap with closed contact and with the offset."""
    closed = flow_factors(gap, spacing)
    try:
        raised = np.diag(flow_factors(gap, spacing, offset=OFFSET).factors.pressure)
    except ConvergenceError:
        raised = np.full(2, np.nan)
    factors: FlowFactors = closed.factors
    return Offset(
        separation=separation,
        contact=closed.contact,
        closed=np.diag(factors.pressure),
        offset=raised,
        relative=np.diag(factors.relative.pressure),
    )


def _made(roughness: float, points: int) -> Surface:
    return self_affine(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=811,
        rms_height=roughness,
        hurst=0.8,
        roll_off=SIDE / 4,
        cut_off=SIDE / 64,
    )
