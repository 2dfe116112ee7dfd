"""Flow factors: averaged conductance, drag and friction of a periodic rough gap, relative to a smooth film."""
