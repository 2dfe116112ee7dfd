"""Tables of flow factors over the mean gap: placing their points, interpolation between these, and files."""
