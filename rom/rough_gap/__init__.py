"""Flow through the gap between rough walls."""
