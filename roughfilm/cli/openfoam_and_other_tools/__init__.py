"""The commands under 'OpenFOAM and other tools' in the help, one a file."""
