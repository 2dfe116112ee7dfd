"""Figures of shafts in bores."""
