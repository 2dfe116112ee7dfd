"""Paper D of the source: its figures regenerated, its claims judged."""
