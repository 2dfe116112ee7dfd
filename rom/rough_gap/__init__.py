"""Models of flow through the gap between rough walls."""
