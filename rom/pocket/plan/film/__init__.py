"""The thin-film Navier-Stokes equations over a cell in plan."""
