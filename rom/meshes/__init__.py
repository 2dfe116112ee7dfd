"""Meshes of results for other tools."""
