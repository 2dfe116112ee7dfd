"""Paper B of the source: its figures regenerated, its claims judged."""
