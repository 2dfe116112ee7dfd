"""Mixed lubrication: load shared by a film and by the asperities that reach through it."""
