"""Dimples in three dimensions: the best depth and covered part for load, by every model."""
