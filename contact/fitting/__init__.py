"""Descriptions of random surfaces that scatter as the windows of a measurement do, and properties that they lack."""
