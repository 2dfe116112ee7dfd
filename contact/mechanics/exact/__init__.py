"""Closed-form solutions of elastic contact."""
