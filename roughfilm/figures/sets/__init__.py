"""Figures of a set of windows."""
