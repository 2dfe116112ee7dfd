"""Paper F of the source: its figures regenerated, its claims judged."""
