"""Mixed lubrication: film and asperities share the load."""
