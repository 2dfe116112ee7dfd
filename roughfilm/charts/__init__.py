"""Charts of speed against accuracy, with the programs of others."""
