"""The choice of a model for a scene: error laws from its dimensionless numbers, and differences to the next model."""
