"""Permeability of the gap in contact: direct, homogenized and by percolation."""
