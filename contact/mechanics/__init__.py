"""Dry contact of a rough surface with a flat plane: elastic, elastic-plastic, and the closed forms beside them."""
