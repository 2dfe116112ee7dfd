"""Batches of cases: jobs, executors, directories and tables."""
