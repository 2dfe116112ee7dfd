"""The commands under 'Upkeep' in the help, one a file."""
