"""Meshes of rough gaps by snappyHexMesh."""
