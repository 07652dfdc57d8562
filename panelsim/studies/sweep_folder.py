"""The folder of a sweep: its statistics, its picture, and all its runs, with which it can go on."""

import json
from contextlib import suppress
from pathlib import Path

import xarray as xr

from panelsim.case import Case
from panelsim.errors import PanelsimError
from panelsim.files import read_json_table, replacing, write_whole
from panelsim.studies.output_folder import make_output_folder, refuse_occupied_folder
from panelsim.studies.run_store import RUN_FILE, RunStore, run_identity

DATASET, TABLE, PICTURE, STARTED = "sweep.nc", "sweep.csv", "sweep.png", "sweep.json"


class SweepFolder:
    """A folder that a sweep writes to; `store` has its runs."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.store = RunStore(path / "runs")

    def require_free(self, case: Case, *, force: bool, resume: bool) -> None:
        """Raise PanelsimError for a folder in use, unless by `force`, or to `resume` a sweep of this case.

        A sweep of this case that was stopped before its statistics were written goes on without `resume`.
        """
        if resume and force:
            raise PanelsimError(
                "--resume goes on with the sweep in the folder, and --force begins it anew",
                got="both",
                remedy="give one of them",
            )
        if force:
            refuse_occupied_folder(self.path, force=True)
            return
        started = self._started()
        of_this_case = started == run_identity(case)
        if resume:
            refuse_occupied_folder(self.path, force=True)
            if not of_this_case:
                raise PanelsimError(
                    "There is no sweep of this case to go on with in the output folder",
                    got=f"{self.path} {'without a sweep' if started is None else 'of another case'}",
                    remedy="choose its folder with --out, or leave out --resume to run the sweep from its"
                    " start",
                )
        elif of_this_case and (self.path / DATASET).exists():
            raise PanelsimError(
                "The output folder has a sweep of this case already",
                got=self.path,
                remedy="use --resume to keep its runs and make only those that are new,"
                " or --force to take them away and begin anew",
            )
        else:
            refuse_occupied_folder(self.path, force=of_this_case)

    def _started(self) -> str | None:
        """The `run_identity` of the case whose sweep was begun here.

        Raises PanelsimError for a note that is not one of ours.
        """
        file = self.path / STARTED
        if not file.is_file():
            return None
        told = read_json_table(
            file, "The note of the sweep in the output folder", "choose another folder with --out"
        )
        if not isinstance(told.get("identity"), str):
            raise PanelsimError(
                "The file in the output folder is no note of a sweep",
                got=file,
                remedy="choose another folder with --out",
            )
        return str(told["identity"])

    def begin(self, case: Case, *, anew: bool) -> None:
        """Make the folder and note whose sweep it is; `anew` takes away what an older one left.

        Nothing is taken away but files that a sweep made, and nothing where no sweep was begun.
        """
        make_output_folder(self.path)
        with suppress(PanelsimError):
            if self._started() is not None:
                # Drawn again at the end, where what was found can be drawn.
                (self.path / PICTURE).unlink(missing_ok=True)
                if anew:
                    self._take_away()
        write_whole(self.path / STARTED, json.dumps({"identity": run_identity(case)}).encode())

    def _take_away(self) -> None:
        """Remove the statistics and runs of a sweep."""
        runs = self.store.folder.iterdir() if self.store.folder.is_dir() else ()
        ours = [file for file in runs if RUN_FILE.fullmatch(file.name)]
        for file in [self.path / DATASET, self.path / TABLE, *ours]:
            file.unlink(missing_ok=True)

    def write(self, found: xr.Dataset) -> list[str]:
        """Write the statistics as NetCDF and CSV, and draw them where they can be drawn; the files' names."""
        write_whole(self.path / DATASET, bytes(found.to_netcdf(engine="h5netcdf")))
        with replacing(self.path / TABLE) as beside:
            found.to_dataframe(dim_order=list(found["rms"].dims)).to_csv(beside)
        from panelsim.view.sweep_picture import sweep_picture  # brings matplotlib

        drawn = sweep_picture(found, self.path / PICTURE)
        return [DATASET, TABLE, *([PICTURE] if drawn else [])]
