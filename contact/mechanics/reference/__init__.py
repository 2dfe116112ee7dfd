"""The contact algorithm of the source, kept for comparison."""
