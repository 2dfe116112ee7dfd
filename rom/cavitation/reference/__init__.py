"""The cavitation algorithms of the source and of the literature, kept for comparison."""
