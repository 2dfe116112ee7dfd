"""A description whose seeds scatter as the windows of a surface do, and its test with windows that were not fitted."""
