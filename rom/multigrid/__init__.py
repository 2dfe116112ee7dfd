"""Multigrid for thin-film problems on a grid: fast whatever the contrast, the anisotropy or the holes in the film."""
