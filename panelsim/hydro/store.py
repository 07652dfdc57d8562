"""Where databases are kept, so that no ship is solved twice: with the bundled hulls, and in a cache."""

import contextlib
import hashlib
import json
import os
from pathlib import Path

from panelsim.errors import PanelsimError
from panelsim.hull.form import bundled_hull_names, hull_folder
from panelsim.hydro.database import HydroDatabase, Progress
from panelsim.hydro.database_file import FORMAT
from panelsim.hydro.strip.section_forms import SectionForm
from panelsim.ship.ship import Ship, require_ship

STORED_NAME = "hydro.nc"


def cache_folder() -> Path:
    """`$PANELSIM_CACHE`, else `panelsim` in the user's cache folder."""
    own = os.environ.get("PANELSIM_CACHE")
    if own:
        return Path(own)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "panelsim"


def database_for(
    ship: Ship,
    progress: Progress | None = None,
    method: str = "bem",
    section_form: SectionForm = "close-fit",
) -> HydroDatabase:
    """The database of a ship: bundled with its hull, cached from an earlier run, or computed and cached.

    `method` and `section_form` as in `HydroDatabase.compute`; those that are bundled are by "bem".
    `progress(done, total)` is called only while one is computed. Raises PanelsimError for what is no
    ship, and as `compute` does.
    """
    require_ship(ship)
    stored = stored_database(ship, method, section_form)
    if stored is not None:
        return stored
    database = HydroDatabase.compute(ship, method, progress=progress, section_form=section_form)
    # A cache that cannot be written costs the next run its time, and this one nothing.
    with contextlib.suppress(PanelsimError):
        database.save(_cached_at(ship, method, section_form), overwrite=True)
    return database


def stored_database(
    ship: Ship, method: str = "bem", section_form: SectionForm = "close-fit"
) -> HydroDatabase | None:
    """What `database_for` need not compute: the database bundled with the hull or cached, or None."""
    if method == "bem" and ship.form is not None and ship.form.name in bundled_hull_names():
        bundled = _matching(hull_folder(ship.form.name) / STORED_NAME, ship)
        if bundled is not None:
            return bundled
    return _matching(_cached_at(ship, method, section_form), ship)


def _cached_at(ship: Ship, method: str, section_form: SectionForm) -> Path:
    return cache_folder() / f"{_cache_key(ship, method, section_form)}.nc"


def _matching(path: Path, ship: Ship) -> HydroDatabase | None:
    """The database at the path if it is there, whole, and of this ship."""
    if not path.is_file():
        return None
    try:
        database = HydroDatabase.load(path)
        database.require_for(ship)
    except PanelsimError:
        return None
    return database


def _cache_key(ship: Ship, method: str, section_form: SectionForm) -> str:
    """Hash of what coefficients depend on, without the longitudinal CG, which moves with the panelling."""
    identity = {k: v if isinstance(v, str) else f"{v:.4g}" for k, v in ship.identity().items()}
    del identity["center_of_gravity_x"]
    solved = [FORMAT, method, section_form, identity] if method == "strip" else [FORMAT, method, identity]
    return hashlib.sha256(json.dumps(solved, sort_keys=True).encode()).hexdigest()[:20]
