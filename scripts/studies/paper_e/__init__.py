"""Paper E of the source: its figures regenerated, its claims judged."""
