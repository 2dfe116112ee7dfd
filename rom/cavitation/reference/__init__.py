"""Cavitation algorithms of the source and of the literature, for comparison."""
