"""The state of a rough surface under load: pressure, displacement, gap and contact area."""

import math
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.mechanics import kernels

PERIMETER_CORRECTION = (math.pi - 1 + math.log(2)) / 24
"""Mean excess of an area counted in pixels, over the length of its perimeter in pixels."""

STEP_GAP, STEP_PRESSURE = 2.0, 0.9
"""At a step of the surface, smallest gap beside the last pixel over the difference of the elastic displacements, and
smallest pressure of that pixel over that of the next one inside."""


@dataclass(frozen=True, kw_only=True)
class Contact:
    """The state of a rough surface under a rigid plane at one load; arrays have the shape (nx, ny).

    Attributes
    ----------
    load : W, mean pressure over the nominal area, Pa.
    hardness : H, largest pressure, Pa; infinite for an elastic solid.
    heights : z of the undeformed surface, m.
    spacing : (dx, dy), m.
    pressure : p, Pa; 0 off contact, H where plastic.
    elastic_displacement : u_e = K ∗ p, m, into the solid; of zero mean if periodic.
    plastic_displacement : u_p, m, into the solid; 0 where p < H.
    approach : g00, m; displacement of the plane beyond the first touch, against the mean of u_e (Fig. E.14).
    gap : distance between the deformed surface and the plane, m; 0 in contact.
    complementarity : largest violation of the contact conditions over the rms height, evaluated for the pressure
        returned, with u_e recomputed.
    iterations : number of iterations on the finest grid.
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

    __repr__ = brief

    @property
    def in_contact(self) -> Mask:
        """Mask of the points in contact, p > 0."""
        return self.pressure > 0

    @property
    def plastic(self) -> Mask:
        """Mask of the plastic points, p = H."""
        return self.pressure >= self.hardness

    @property
    def area_fraction_pixel(self) -> float:
        """Real over nominal contact area, as the fraction of pixels in contact."""
        return float(np.count_nonzero(self.in_contact)) / self.pressure.size

    @property
    def area_fraction(self) -> float:
        """Real over nominal contact area, corrected for the mean excess of whole pixels along a smooth perimeter.

        A = A_pix − (π − 1 + ln 2)/24 S Δx, where S is the length of the pixel edges between contact and open gap; line
        contact needs no correction. Edges that pixels meet exactly do not count: those of plastic pixels, which carry
        the hardness on their whole area, so that A is at least W/H, and steps of the surface such as pillars, beside
        which the pressure does not fall and the gap does not begin at zero. Source: V. A. Yastrebov, G. Anciaux,
        J. F. Molinari, Tribol. Int. 114 (2017) 161, doi:10.1016/j.triboint.2017.04.023, for smooth surfaces.
        """
        if 1 in self.pressure.shape:
            return self.area_fraction_pixel
        out = np.empty(1)
        kernels.smooth_edges(
            self.pressure, self.elastic_displacement, self.gap, self.hardness, STEP_GAP, STEP_PRESSURE, out
        )
        corrected = self.area_fraction_pixel - PERIMETER_CORRECTION * float(out[0]) / self.pressure.size
        return max(corrected, self.load / self.hardness)

    @property
    def plastic_fraction(self) -> float:
        """Plastic over nominal area, as the fraction of plastic pixels."""
        return float(np.count_nonzero(self.plastic)) / self.pressure.size

    @property
    def plasticity_index(self) -> float:
        """Plastic over real contact area, both counted in pixels (thesis, D.4)."""
        return self.plastic_fraction / self.area_fraction_pixel

    @property
    def mean_gap(self) -> float:
        """Mean gap over the nominal area, m."""
        return float(self.gap.mean())

    @property
    def loaded_heights(self) -> Array:
        """Heights of the surface under load, z − u_e − u_p, shape (nx, ny), m."""
        return self.heights - self.elastic_displacement - self.plastic_displacement

    @property
    def unloaded_heights(self) -> Array:
        """Heights of the surface after unloading, z − u_p, shape (nx, ny), m."""
        return self.heights - self.plastic_displacement
