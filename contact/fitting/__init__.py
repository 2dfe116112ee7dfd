"""Descriptions of random surfaces that scatter as the windows of a measurement do, and what such windows have more."""
