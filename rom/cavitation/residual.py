"""The residual at which the solvers of films stop."""

RESIDUAL_TOLERANCE = 1e-9
"""Residual at which a solver stops by default."""
