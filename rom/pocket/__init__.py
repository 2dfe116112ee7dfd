"""A film over one period of a textured wall: Reynolds, inertia and slope."""
