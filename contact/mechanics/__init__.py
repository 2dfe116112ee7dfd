"""Dry contact of a rough surface with a rigid plane: elastic and elastic-plastic solvers, estimates, closed forms."""
