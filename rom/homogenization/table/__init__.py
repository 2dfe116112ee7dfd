"""Tables of flow factors over the mean gap: choice of their points, interpolation, and files."""
