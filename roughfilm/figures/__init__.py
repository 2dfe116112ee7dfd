"""Figures by matplotlib and pictures by pyvista."""
