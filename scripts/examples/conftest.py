"""Keeps pytest from importing the programs of the gallery, which tests/scripts/examples runs."""

collect_ignore = ["gallery"]
