"""Published numbers that the code answers: tables of facts, one module for each source, and the comparison."""
