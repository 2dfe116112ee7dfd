"""A rough surface under load: who carries what, and what is left open."""

import math
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask

CORNERS = (math.pi - 1 + math.log(2)) / 24
"""By which part of its perimeter, in pixels, an area counted in pixels is too large on average."""


@dataclass(frozen=True, kw_only=True)
class Contact:
    """The state of a rough surface under a flat plane at one load. Arrays are (nx, ny).

    Attributes
    ----------
    load : mean pressure over the nominal area W, Pa.
    hardness : H, Pa, the greatest pressure; infinite for an elastic solid.
    heights : of the undeformed surface z, m.
    spacing : (dx, dy), m.
    pressure : p, Pa; 0 off contact, H where plastic.
    elastic_displacement : u_e = K ∗ p, m, into the solid; of zero mean if periodic.
    plastic_displacement : u_p, m, into the solid; 0 where p < H.
    approach : g00, m: how far the plane went beyond the first touch, against the mean of u_e (Fig. E.14).
    gap : between the deformed surface and the plane, m; 0 in contact.
    complementarity : by how much the conditions of contact are broken at the worst node, over the rms height: certified
        on the pressure returned, with u_e computed afresh.
    iterations : of the solver, on the grid itself.
    """

    load: float
    hardness: float
    heights: Array
    spacing: tuple[float, float]
    pressure: Array
    elastic_displacement: Array
    plastic_displacement: Array
    approach: float
    gap: Array
    complementarity: float
    iterations: int

    @property
    def in_contact(self) -> Mask:
        """Where p > 0."""
        return self.pressure > 0

    @property
    def plastic(self) -> Mask:
        """Where p = H."""
        return self.pressure >= self.hardness

    @property
    def area_fraction_pixel(self) -> float:
        """Real area of contact over the nominal one, in pixels."""
        return float(np.count_nonzero(self.in_contact)) / self.pressure.size

    @property
    def area_fraction(self) -> float:
        """Real area of contact over the nominal one, less what whole pixels add along its perimeter.

        A = A_pix − (π − 1 + ln 2)/24 S Δx, with S the length of the pixels' edges between contact and not; no such
        thing in line contact. Pixels at the hardness carry it on all their area, so that their edges do not count, and
        A is at least W/H. Source: V. A. Yastrebov, G. Anciaux, J. F. Molinari, Tribol. Int. 114 (2017) 161,
        doi:10.1016/j.triboint.2017.04.023.
        """
        if 1 in self.pressure.shape:
            return self.area_fraction_pixel
        off, elastic = self.pressure == 0, self.in_contact & ~self.plastic
        edges = sum(np.count_nonzero(elastic & np.roll(off, shift, axis)) for axis in (0, 1) for shift in (1, -1))
        return max(float(self.area_fraction_pixel - CORNERS * edges / off.size), self.load / self.hardness)

    @property
    def plastic_fraction(self) -> float:
        """Plastic area over the nominal one, in pixels."""
        return float(np.count_nonzero(self.plastic)) / self.pressure.size

    @property
    def plasticity_index(self) -> float:
        """Plastic over real area of contact, in pixels (thesis, D.4)."""
        return self.plastic_fraction / self.area_fraction_pixel

    @property
    def mean_gap(self) -> float:
        """Mean of the gap over the nominal area, m."""
        return float(self.gap.mean())

    @property
    def loaded_heights(self) -> Array:
        """Of the surface under load, z − u_e − u_p, m."""
        return self.heights - self.elastic_displacement - self.plastic_displacement

    @property
    def unloaded_heights(self) -> Array:
        """Of the surface after the load is taken off, z − u_p, m."""
        return self.heights - self.plastic_displacement
