"""Checks of answers by exact solutions, conservation laws and other physical laws."""
