"""Sinusoidal walls of a rough gap."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Wave:
    """A sinusoidal wall under a flat wall, at the mean gap h̄: z = a h̄ cos(2πx/L), or a h̄ cos(2πx/L) cos(2πy/L).

    Attributes
    ----------
    amplitude : a, amplitude over the mean gap.
    wavelength : L/h̄, wavelength over the mean gap.
    bumps : whether the wall has bumps (second formula) and not ridges (first formula).
    """

    amplitude: float
    wavelength: float
    bumps: bool = False

    @property
    def slope(self) -> float:
        """The rms slope √2 π a h̄/L, which is the same for bumps and ridges."""
        return float(np.sqrt(2) * np.pi * self.amplitude / self.wavelength)

    @property
    def kind(self) -> str:
        """The word for the wave: bumps or ridges."""
        return "bumps" if self.bumps else "ridges"

    @property
    def name(self) -> str:
        """The name of the wave in a file path."""
        return f"{self.kind}-a{self.amplitude:.12g}-L{self.wavelength:g}"
