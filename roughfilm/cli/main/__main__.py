"""``python -m roughfilm.cli.main`` is the ``roughfilm`` command."""

from roughfilm.cli.main import main

if __name__ == "__main__":
    main()
