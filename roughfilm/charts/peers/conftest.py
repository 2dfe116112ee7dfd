"""Nothing here is collected: these are programs for other Pythons, which have libraries that the project has not."""

collect_ignore_glob = ["*.py"]
