"""The truth of a cell with deep dimples, the same flow; ``dimples`` judges the models by their own equations."""

from scripts.studies.coverage.truths.dimples import whole as truth

__all__ = ["truth"]
