"""The thin-film Navier-Stokes equations along a gap: inertia in full, slope to second order."""
