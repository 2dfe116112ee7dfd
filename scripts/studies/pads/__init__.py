"""Inertia in textured pads: where it adds load and where it takes it."""
