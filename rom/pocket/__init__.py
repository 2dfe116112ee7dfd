"""Models of a film over one period of a grooved wall, with inertia and slope effects."""
