"""The command line with the model ``moody`` on the ladder, here and in every worker, which runs this file too."""

from pathlib import Path

from roughfilm.rom.pocket import models

if __name__ in ("__main__", "__mp_main__"):
    models.__path__.append(str(Path(__file__).parent / "models"))

if __name__ == "__main__":
    from roughfilm.cli.main import main

    main()
