"""OpenFOAM itself: installation, dictionaries, meshes, runs and residuals."""
