"""Meshes of surfaces and gaps, and the files other tools read them from."""
