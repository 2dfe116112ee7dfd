"""Console output, options, exit codes and progress bars of the commands."""
