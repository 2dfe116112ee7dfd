"""Study of the range in which a rough gap needs the Stokes or the Navier-Stokes equations."""
