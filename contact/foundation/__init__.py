"""Arrays, errors, units, files, threads and child processes that every other folder uses."""
