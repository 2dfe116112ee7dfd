"""Which rung is enough for a scene: told before it is solved, by its numbers, and after, by the next rung."""
