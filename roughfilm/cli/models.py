"""roughfilm models: the models of each kind of scene."""

from rich.table import Column, Table

from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import kinds
from roughfilm.rom.ladder.model import Resolutions
from roughfilm.terminal.console import AsJson, output, print_json


def command(as_json: AsJson = False) -> None:
    """Show the models of each kind of scene: what each adds, and whether it can run here or why not."""
    rows = [(model, model.available(), model.resolutions) for model in models()]
    if as_json:
        print_json(
            {
                "models": [
                    {
                        "name": model.name,
                        "kind": model.kind,
                        "adds": model.summary,
                        "keeps": sorted(model.keeps),
                        "resolution": offered.default if isinstance(offered, Resolutions) else None,
                        "resolution_meaning": model.resolution_meaning,
                        "schemes": model.schemes,
                        "available": here.available,
                        "detail": here.detail,
                    }
                    for model, here, offered in rows
                ]
            }
        )
        return
    for kind in kinds().values():
        name = Column("model", no_wrap=True)
        title = f"The ladder of {kind.name}, {kind.summary}, plainest first"
        table = Table(name, "what it adds", "resolution and schemes", "here", title=title)
        for model, here, offered in rows:
            if model.kind == kind.name:
                own = offered.default if isinstance(offered, Resolutions) else "the scene's own"
                table.add_row(
                    model.name,
                    model.summary,
                    "; ".join((f"{own} {model.resolution_meaning}", *model.schemes)),
                    ("[green]yes[/]: " if here.available else "[red]no[/]: ") + here.detail,
                )
        output.print(table)
