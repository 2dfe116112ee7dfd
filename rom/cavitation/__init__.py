"""The Reynolds equation where the film may rupture: mass-conserving, for any compressibility."""
