"""The parts that all OpenFOAM cases share: installation, dictionaries, meshes, runs and residuals."""
