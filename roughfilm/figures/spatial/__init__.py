"""Pictures of surfaces in space."""
