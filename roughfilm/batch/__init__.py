"""Batches of cases: their jobs, executors, directories and tables."""
