"""Surfaces made from a few numbers and a seed: periodic, and the same bytes every time.

One file a family: ``self_affine``, ``gaussian``, ``sinusoids``, ``cross_hatch``, ``milled``, ``plateau_honed``; and
``profile`` makes ground profiles of given ``four_moments``. ``description`` reads surfaces from TOML; ``distribution``
changes heights and keeps the spectrum; ``rearrangement`` keeps heights and changes their order. A height belongs to a
place, x = i dx and y = j dy, and is not a pixel's mean: a grid twice as fine holds the heights of the coarse one.
"""
