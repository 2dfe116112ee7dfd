"""Surfaces as heights on a grid, and the files that hold them."""
