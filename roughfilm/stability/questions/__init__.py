"""The inputs that a map asks each solver for."""
