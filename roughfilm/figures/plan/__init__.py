"""Figures of cells in plan."""
