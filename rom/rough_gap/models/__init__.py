"""The models of a rough gap without OpenFOAM, one per file."""
