"""The commands under 'Bearings and seals' in the help, one a file."""
