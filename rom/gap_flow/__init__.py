"""Stokes flow in a rough gap without a mesh: thin-film theory, what slope adds to it, and how far that holds."""
