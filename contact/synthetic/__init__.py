"""Surfaces made from a few numbers and a seed: periodic, the same bytes every time, on any grid.

One file a family (``self_affine``, ``gaussian``, ``sinusoids``, ``cross_hatch``, ``milled``, ``plateau_honed``); ``description``
reads them from TOML; ``distribution`` changes the heights and keeps the spectrum; ``rearrangement`` keeps the heights and
changes their order. A height belongs to a place, x = i dx and y = j dy, and not to a pixel's mean, so that a grid twice as
fine holds the heights of the coarse one.
"""
