"""Options that several commands have."""

from typing import Annotated

import typer

Force = Annotated[bool, typer.Option("--force", help="Replace files that panelsim writes.")]
Overrides = Annotated[
    list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Override, e.g. seaway.seed=7.")
]
EXIT_BAD_INPUT = 2
EXIT_ENDED_EARLY = 3
