"""Meshes of surfaces and gaps, and files that other tools read."""
