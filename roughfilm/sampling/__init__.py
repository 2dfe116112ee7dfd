"""Many windows of a measurement, or many seeds of a description: quantities of each, their scatter and its causes."""
