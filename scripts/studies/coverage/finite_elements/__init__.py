"""Steady plane Navier-Stokes flow in a gap with grooves, by Taylor-Hood finite elements (scikit-fem)."""
