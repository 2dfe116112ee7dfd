"""Paper C of the source: its figures regenerated, its claims judged."""
