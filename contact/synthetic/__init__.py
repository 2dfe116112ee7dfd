"""Periodic surfaces generated from a few parameters and a seed, reproducible bit for bit.

There is a module for each family: ``self_affine``, ``gaussian``, ``sinusoids``, ``cross_hatch``, ``milled`` and
``plateau_honed``; ``profile`` generates ground profiles with given ``four_moments``. ``description`` reads surfaces
from TOML; ``distribution`` changes the heights and keeps the spectrum; ``rearrangement`` keeps the heights and changes
their order. Heights are point values at x = i dx, y = j dy, so that a grid twice as fine contains those of the coarse
one.
"""
