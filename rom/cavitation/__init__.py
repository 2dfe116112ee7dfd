"""The Reynolds equation with mass-conserving cavitation, for any compressibility."""
