"""The folder of a sweep: its statistics, its picture, and all its runs, with which it can go on."""

import json
from pathlib import Path

import xarray as xr

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.files import replacing, write_whole
from panelsim.studies.output_folder import make_output_folder, refuse_occupied_folder
from panelsim.studies.run_store import RunStore, run_identity

DATASET, TABLE, PICTURE, STARTED = "sweep.nc", "sweep.csv", "sweep.png", "sweep.json"


class SweepFolder:
    """A folder that a sweep writes to; `store` has its runs."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.store = RunStore(path / "runs")

    def require_free(self, case: Case, *, force: bool, resume: bool) -> None:
        """Raise PanelsimError for a folder in use, unless by `force`, or to `resume` a sweep of this case."""
        if resume and force:
            raise PanelsimError(
                "--resume goes on with the sweep in the folder, and --force begins it anew",
                got="both",
                remedy="give one of them",
            )
        refuse_occupied_folder(self.path, force=force or resume)
        if resume and self._started() != run_identity(case):
            raise PanelsimError(
                "There is no sweep of this case to go on with in the output folder",
                got=f"{self.path} {'without a sweep' if self._started() is None else 'of another case'}",
                remedy="choose its folder with --out, or leave out --resume to run the sweep from its start",
            )

    def _started(self) -> str | None:
        """The `run_identity` of the case whose sweep was begun here."""
        file = self.path / STARTED
        return json.loads(file.read_text(encoding="utf-8"))["identity"] if file.is_file() else None

    def begin(self, case: Case, *, anew: bool) -> None:
        """Make the folder and note whose sweep it is; `anew` takes away what an older one left."""
        make_output_folder(self.path)
        if anew:
            old = [self.path / name for name in (DATASET, TABLE, PICTURE, STARTED)]
            for file in [*old, *self.store.folder.glob("*.nc"), *self.store.folder.glob("*.failed.json")]:
                file.unlink(missing_ok=True)
        write_whole(self.path / STARTED, json.dumps({"identity": run_identity(case)}).encode())

    def write(self, found: xr.Dataset) -> list[str]:
        """Write the statistics as NetCDF and CSV, and draw them where they can be drawn; the files' names."""
        write_whole(self.path / DATASET, bytes(found.to_netcdf(engine="h5netcdf")))
        with replacing(self.path / TABLE) as beside:
            found.to_dataframe(dim_order=list(found["rms"].dims)).to_csv(beside)
        from panelsim.view.sweep_picture import sweep_picture  # brings matplotlib

        (self.path / PICTURE).unlink(missing_ok=True)
        drawn = sweep_picture(found, self.path / PICTURE)
        return [DATASET, TABLE, *([PICTURE] if drawn else [])]
