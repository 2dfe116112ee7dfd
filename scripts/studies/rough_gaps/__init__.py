"""Where a rough gap needs the Stokes or the Navier-Stokes equations."""
