"""Sinusoidal walls of a rough gap."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Wave:
    """Heights a cos(2πx/L) h̄, or a cos(2πx/L) cos(2πy/L) h̄ if ``bumps``, under a flat wall; L in mean gaps h̄."""

    amplitude: float
    wavelength: float
    bumps: bool = False

    @property
    def slope(self) -> float:
        """Rms slope; of bumps and ridges alike."""
        return float(np.sqrt(2) * np.pi * self.amplitude / self.wavelength)

    @property
    def name(self) -> str:
        """Fit for a directory."""
        return f"{'bumps' if self.bumps else 'ridges'}-a{self.amplitude:.12g}-L{self.wavelength:g}"
