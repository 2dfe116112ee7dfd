"""Error laws of the advice, which are fitted to random scenes and checked on others."""
