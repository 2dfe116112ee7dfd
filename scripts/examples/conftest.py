"""Keeps pytest from importing the example programs, which the tests run."""

collect_ignore = ["python"]
