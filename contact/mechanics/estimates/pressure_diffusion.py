"""The pressure density of rough contact in Persson's theory, by diffusion with absorption at 0 and at the hardness."""

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.checks import finite

GAUSSIAN_CUT_OFF = 9.0
"""Number of standard deviations beyond which a Gaussian, or the decay of a mode, is 0 to rounding."""


@dataclass(frozen=True, kw_only=True)
class PressureDiffusion:
    """The density f(p) with ∂f/∂V = ½ ∂²f/∂p², f = δ(p − P) for V = 0, and f = 0 at p = 0 and p = H.

    Each scale of roughness adds a random increment to the pressure. Area whose pressure reaches 0 loses contact, area
    whose pressure reaches H becomes plastic, both permanently; the mean pressure stays P.

    Attributes
    ----------
    load : P, Pa; 0 < P <= H.
    spread : sqrt(V), Pa, above 0: standard deviation of the pressure in full contact, E* g'/2.
    hardness : H, Pa, or inf.

    Notes
    -----
    The density is a sum of Gaussians and their images at 0 and H for spread < H, else a sum of sines; both are exact to
    rounding.

    Source: Persson, J. Chem. Phys. 115 (2001) 3840, doi:10.1063/1.1388626; Persson, Phys. Rev. Lett. 87 (2001) 116101,
    doi:10.1103/PhysRevLett.87.116101.
    """

    load: float
    spread: float
    hardness: float = math.inf

    def density(self, pressure: ArrayLike) -> Array:
        """The density f, 1/Pa, at pressures of any shape, Pa; 0 outside 0 < p < H."""
        p = finite("pressure_diffusion.pressure", pressure)
        within = (p > 0) & (p < self.hardness)
        if self._by_images:
            width, shifts = math.sqrt(2) * self.spread, self._shifts()
            one, other = ((p[..., None] + sign * self.load - shifts) / width for sign in (-1, 1))
            total = (np.exp(-(one**2)) - np.exp(-(other**2))).sum(axis=-1) / (math.sqrt(math.pi) * width)
        else:
            n, modes, decay = self._modes()
            total = np.sin(p[..., None] * n * (math.pi / self.hardness)) @ (2 / self.hardness * modes * decay)
        return np.where(within, np.maximum(total, 0.0), 0.0)

    @property
    def elastic(self) -> float:
        """Elastic over nominal area, ∫ f dp."""
        if self._by_images:
            terms = self._image_terms()
            return max(math.erf(self.load / (math.sqrt(2) * self.spread)) + float((terms[1::2] - terms[::2]).sum()), 0)
        n, modes, decay = self._modes()
        return max(float(np.sum((4 / (math.pi * n) * modes * decay)[::2])), 0.0)

    @property
    def plastic(self) -> float:
        """Plastic over nominal area."""
        if self._by_images:
            return float(self._image_terms()[::2].sum())
        n, modes, decay = self._modes()
        signs = np.where(n % 2 == 1, 1.0, -1.0)
        return self.load / self.hardness - float(np.sum(2 / (math.pi * n) * signs * modes * decay))

    def _image_terms(self) -> Array:
        """Terms erfc((mH − P)/sqrt(2V)) − erfc((mH + P)/sqrt(2V)), m = 1, 2, ..., shape (n,) with even n."""
        width, walls = math.sqrt(2) * self.spread, self.hardness * np.arange(1, 2 * self._images + 3)
        return np.asarray(
            scipy.special.erfc((walls - self.load) / width) - scipy.special.erfc((walls + self.load) / width)
        )

    @property
    def _by_images(self) -> bool:
        return self.spread < self.hardness

    @property
    def _images(self) -> int:
        """Number of images on either side that contribute."""
        return math.ceil(GAUSSIAN_CUT_OFF * self.spread / self.hardness) + 1 if math.isfinite(self.hardness) else 0

    def _shifts(self) -> Array:
        count = self._images
        return np.asarray(2 * self.hardness * np.arange(-count, count + 1) if count else np.zeros(1))

    def _modes(self) -> tuple[Array, Array, Array]:
        """Mode numbers n, sin(nπP/H) and exp(−n²π²V/(2H²)), each of shape (modes,)."""
        rate = math.pi * self.spread / self.hardness
        n = np.arange(1.0, math.ceil(GAUSSIAN_CUT_OFF / rate) + 2)
        return n, np.sin(n * math.pi * (self.load / self.hardness)), np.exp(-((n * rate) ** 2) / 2)
