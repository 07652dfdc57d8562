"""What a run leaves behind: every motion and every load, with the ship and the waves that made them."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from panelsim.conventions import DOF_NAMES, FloatArray, IntArray
from panelsim.errors import PanelsimError
from panelsim.files import as_path, require_new, write_whole
from panelsim.seaway.components import WaveComponents

if TYPE_CHECKING:  # only its fields are read: a saved history opens without the hull package
    from panelsim.ship.ship import Ship

BoolArray = NDArray[np.bool_]

HISTORY_FORMAT = 1
OUTCOMES = ("finished", "capsized", "diverged", "interrupted")

COMPONENT_UNITS = {"amplitude": "m", "frequency": "rad/s", "wave_heading": "rad", "phase": "rad"}
LOADING_UNITS = {
    "mass": "kg",
    "center_of_gravity": "m",
    "gyradii": "m",
    "draft": "m",
    "trim": "rad",
    "length": "m",
    "beam": "m",
    "water_density": "kg/m3",
    "gravity": "m/s2",
}


def _units(linear: str, angular: str) -> str:
    return f"{linear} (surge, sway, heave), {angular} (roll, pitch, yaw)"


SIGNAL_UNITS = {
    "displacement": _units("m", "rad"),
    "velocity": _units("m/s", "rad/s"),
    "acceleration": _units("m/s2", "rad/s2"),
}
LOAD_UNITS = _units("N", "N m")


@dataclass(frozen=True, eq=False)
class History:
    """A run in translating earth axes, an `xarray.DataTree` underneath; make one with `History.build`.

    Root: dims `time` [s] and `dof` (surge … yaw); `displacement`, `velocity`, `acceleration` and
    every `load_<name>` (time, dof), `wave_elevation` (time) [m] at the moving origin. Groups: `mesh`
    (`vertices` (V, 3) [m] in ship axes, `panels` (N, 4), attribute `waterline` [m]), `loading`
    (mass, centre of gravity in hull axes, …) and `seaway` (one value a wave component); `restart` in a run
    that can go on, `points/NAME` for every named point of the ship. Angles in rad.
    """

    tree: xr.DataTree

    def __post_init__(self) -> None:
        for node in self.tree.subtree:
            for variable in node.data_vars.values():
                variable.values.setflags(write=False)

    @classmethod
    def build(
        cls,
        *,
        time: FloatArray,
        displacement: FloatArray,
        velocity: FloatArray,
        acceleration: FloatArray,
        wave_elevation: FloatArray,
        loads: Mapping[str, FloatArray],
        ship: "Ship",
        components: WaveComponents,
        seaway_kind: str,
        stretching: str,
        speed: float,
        ramp: float,
        time_step: float,
        model: str,
        pressure_method: str = "none",
        pressure_rule: str = "none",
        outcome: str,
        outcome_detail: str = "",
        case: str = "{}",
        seed: int | None = None,
        cpu_seconds: float = np.nan,
        jit_seconds: float = 0.0,
        notes: Sequence[str] = (),
        stepper: str = "none",
        restart: xr.Dataset | None = None,
        roll_damping: str = "none",
        coefficients: str = "not recorded",
        inertia: str = "not recorded",
        transom_terms: bool = False,
    ) -> "History":
        """Gather what a run has computed, whole or cut short.

        `time` (T,) [s] from the start of the ramp; motions and each of `loads` (T, 6) in translating
        earth axes, m and rad, N and N m; `wave_elevation` (T,) [m] at the moving origin; `ship` and
        `components` as the run had them; `pressure_method`, `pressure_rule` of the nonlinear load; `speed`
        [m/s]; `ramp` and `time_step` [s]; `case` JSON text; `cpu_seconds` of the time loop alone,
        compilation apart in `jit_seconds`; `notes` are sentences
        that a reader of the report should see; `stepper` the scheme, `restart` what it takes to go on,
        `roll_damping` the terms in words; `coefficients` where they come from, `inertia` that of large angles
        or linear, `transom_terms` whether they are in.
        Raises PanelsimError for an unknown outcome and for arrays that do not fit together.
        """
        if outcome not in OUTCOMES:
            raise PanelsimError("The outcome of a run is unknown", got=outcome, allowed=", ".join(OUTCOMES))
        signals = {"displacement": displacement, "velocity": velocity, "acceleration": acceleration}
        attrs: dict[str, Any] = {
            "history_format": HISTORY_FORMAT,
            "panelsim_version": version("panelsim"),
            "case": case,
            "outcome": outcome,
            "outcome_detail": outcome_detail,
            "model": model,
            "stepper": stepper,
            "roll_damping": roll_damping,
            "coefficients": coefficients,
            "inertia": inertia,
            "transom_terms": "yes" if transom_terms else "no",
            "pressure_method": pressure_method,
            "pressure_rule": pressure_rule,
            "speed": float(speed),
            "ramp": float(ramp),
            "time_step": float(time_step),
            "cpu_seconds": float(cpu_seconds),
            "jit_seconds": float(jit_seconds),
            "notes": json.dumps(list(notes), ensure_ascii=False),
        }
        if seed is not None:
            attrs["seed"] = int(seed)
        root = _root_group(np.asarray(time, dtype=float), signals, loads, wave_elevation)
        attrs["simulated_seconds"] = float(root["time"].values[-1] - root["time"].values[0])
        groups = {
            "/": root.assign_attrs(attrs),
            "/mesh": _mesh_group(ship),
            "/loading": _loading_group(ship),
            "/seaway": _seaway_group(components, kind=seaway_kind, stretching=stretching, ramp=ramp),
        }
        if restart is not None:
            groups["/restart"] = restart
        return cls(xr.DataTree.from_dict(groups))

    @property
    def dataset(self) -> xr.Dataset:
        """The motions and loads as an `xarray.Dataset`."""
        return self.tree.to_dataset()

    @property
    def attrs(self) -> dict[str, Any]:
        """Facts of the run: speed, ramp, time_step, model, outcome, seconds spent, case, version."""
        return {str(name): value for name, value in self.tree.attrs.items()}

    @property
    def outcome(self) -> str:
        """How the run ended: finished, capsized, diverged or interrupted."""
        return str(self.tree.attrs["outcome"])

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader of the results should know, one sentence each."""
        return tuple(json.loads(self.tree.attrs["notes"]))

    @cached_property
    def time(self) -> FloatArray:
        """Time (T,) [s] since the start of the ramp."""
        return self.tree.dataset["time"].values

    @cached_property
    def displacement(self) -> FloatArray:
        """The six motions (T, 6), m and rad."""
        return self.tree.dataset["displacement"].values

    @cached_property
    def velocity(self) -> FloatArray:
        """Rates of the six motions (T, 6), m/s and rad/s."""
        return self.tree.dataset["velocity"].values

    @cached_property
    def acceleration(self) -> FloatArray:
        """Second rates of the six motions (T, 6), m/s2 and rad/s2."""
        return self.tree.dataset["acceleration"].values

    @cached_property
    def wave_elevation(self) -> FloatArray:
        """Waves at the moving origin (T,) [m], positive up from calm water."""
        return self.tree.dataset["wave_elevation"].values

    @cached_property
    def finite(self) -> BoolArray:
        """Rows (T,) before the first motion that is no finite number; a diverged run may end in such."""
        return np.logical_and.accumulate(np.isfinite(self.displacement).all(axis=1))

    @cached_property
    def loads(self) -> dict[str, FloatArray]:
        """Every load by name, (T, 6) each, N and N m; their sum is M η̈."""
        names = [str(name) for name in self.tree.data_vars if str(name).startswith("load_")]
        return {name.removeprefix("load_"): self.tree.dataset[name].values for name in names}

    @cached_property
    def mesh_vertices(self) -> FloatArray:
        """Vertices of the hull (V, 3) [m] in ship axes: origin at the CG, level at rest."""
        return self.tree.children["mesh"].dataset["vertices"].values

    @cached_property
    def panels(self) -> IntArray:
        """Vertex indices of the panels (N, 4), outward; a triangle repeats its third vertex."""
        return self.tree.children["mesh"].dataset["panels"].values

    @cached_property
    def waterline(self) -> float:
        """Height of calm water [m] in ship axes at rest."""
        return float(self.tree["mesh"].attrs["waterline"])

    @cached_property
    def ship_name(self) -> str:
        return str(self.tree["loading"].attrs["name"])

    @cached_property
    def loading(self) -> dict[str, FloatArray]:
        """The loading by name: mass, center_of_gravity (3,), gyradii (3,), draft, trim, …, in SI."""
        group = self.tree.children["loading"].dataset
        return {name: group[name].values for name in LOADING_UNITS}

    @cached_property
    def components(self) -> WaveComponents:
        """The waves at their full amplitude, as after the ramp."""
        group = self.tree.children["seaway"].dataset
        columns = (group[name].values for name in COMPONENT_UNITS)
        # Histories of panelsim 0.1 have first-order waves only.
        return WaveComponents(*columns, second_order=bool(group.attrs.get("second_order", False)))

    @cached_property
    def seaway_attrs(self) -> dict[str, Any]:
        """Of the waves: kind, stretching, ramp [s]."""
        return {str(name): value for name, value in self.tree["seaway"].attrs.items()}

    @cached_property
    def points(self) -> dict[str, xr.Dataset]:
        """What named points of the ship did, by name, as `point_motions` tells it; often none."""
        group = self.tree.children.get("points")
        return {} if group is None else {name: node.to_dataset() for name, node in group.children.items()}

    def same_bits(self, other: "History") -> bool:
        """Whether every variable of both runs agrees bit by bit; timings and other attributes may differ."""
        mine, theirs = dict(_arrays(self.tree)), dict(_arrays(other.tree))
        return mine.keys() == theirs.keys() and all(
            mine[k].dtype == theirs[k].dtype
            and mine[k].shape == theirs[k].shape
            and mine[k].tobytes() == theirs[k].tobytes()
            for k in mine
        )

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write NetCDF-4, whole or not at all; an existing file is refused unless `overwrite`."""
        path = as_path(path)
        require_new(path, "history", overwrite=overwrite)
        encoding = {
            node.path: {
                name: {"zlib": True, "complevel": 4, "shuffle": True}
                for name, variable in node.data_vars.items()
                if variable.size > 1
            }
            for node in self.tree.subtree
        }
        write_whole(path, bytes(self.tree.to_netcdf(engine="h5netcdf", encoding=encoding)))
        return path

    @classmethod
    def load(cls, path: str | Path) -> "History":
        """Read a saved history; the file is closed again.

        Raises PanelsimError for a file that is missing, damaged, no history, or of another format.
        """
        path = as_path(path)
        if not path.is_file():
            raise PanelsimError("There is no such history file", got=path)
        try:
            with xr.open_datatree(path, engine="h5netcdf") as tree:
                tree.load()
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            raise PanelsimError(
                "The history file is damaged or of another kind",
                got=f"{path} ({error})",
                allowed="a history.nc that panelsim wrote to its end",
                remedy="run the case again",
            ) from error
        _require_history(tree, path)
        return cls(tree)


def _root_group(
    time: FloatArray,
    signals: Mapping[str, FloatArray],
    loads: Mapping[str, FloatArray],
    wave_elevation: FloatArray,
) -> xr.Dataset:
    if len(time) == 0 or np.any(np.diff(time) <= 0.0):
        raise PanelsimError("The times of a history do not increase", got=f"{len(time)} times")
    variables: dict[str, tuple[tuple[str, ...], FloatArray, dict[str, str]]] = {
        "wave_elevation": (("time",), wave_elevation, {"units": "m"})
    }
    for name, values in signals.items():
        variables[name] = ("time", "dof"), values, {"units": SIGNAL_UNITS[name]}
    for name, values in loads.items():
        variables[f"load_{name}"] = ("time", "dof"), values, {"units": LOAD_UNITS}
    for name, (dims, values, _) in variables.items():
        expected = (len(time), 6)[: len(dims)]
        if np.shape(values) != expected:
            raise PanelsimError(f"The {name} has the wrong shape", got=np.shape(values), allowed=expected)
    return xr.Dataset(
        {name: (dims, np.array(v, dtype=float), attrs) for name, (dims, v, attrs) in variables.items()},
        coords={"time": ("time", time, {"units": "s"}), "dof": list(DOF_NAMES)},
    )


def _mesh_group(ship: "Ship") -> xr.Dataset:
    return xr.Dataset(
        {
            "vertices": (("vertex", "xyz"), np.array(ship.vertices, dtype=float), {"units": "m"}),
            "panels": (("panel", "corner"), np.array(ship.mesh.panels), {"units": "1"}),
        },
        attrs={"waterline": float(ship.waterline), "axes": "ship: origin CG, x forward, y port, z up"},
    )


def _loading_group(ship: "Ship") -> xr.Dataset:
    values = {name: np.array(getattr(ship, name), dtype=float) for name in LOADING_UNITS}
    return xr.Dataset(
        {name: (("xyz",) * v.ndim, v, {"units": LOADING_UNITS[name]}) for name, v in values.items()},
        attrs={"name": ship.name},
    )


def _seaway_group(components: WaveComponents, **attrs: object) -> xr.Dataset:
    return xr.Dataset(
        {
            name: ("component", np.array(getattr(components, name), dtype=float), {"units": units})
            for name, units in COMPONENT_UNITS.items()
        },
        attrs={**attrs, "second_order": int(components.second_order)},
    )


def _arrays(tree: xr.DataTree) -> Iterator[tuple[str, np.ndarray]]:
    yield "time", tree.dataset["time"].values
    for node in tree.subtree:
        for name, variable in node.data_vars.items():
            yield f"{node.path.rstrip('/')}/{name}", variable.values


def _require_history(tree: xr.DataTree, path: Path) -> None:
    found = tree.attrs.get("history_format")
    if found is None:
        raise PanelsimError("The file is no panelsim history", got=path, allowed="a history.nc of panelsim")
    if found != HISTORY_FORMAT:
        raise PanelsimError(
            "The history is of another format",
            got=f"{path}: format {found}, written by panelsim {tree.attrs.get('panelsim_version')}",
            allowed=f"format {HISTORY_FORMAT}",
            remedy="read it with the panelsim that wrote it, or run the case again",
        )
    if "identity" in tree.attrs:
        raise PanelsimError(
            "This is a run of a study, of which the motions and the wave alone are kept",
            got=path,
            allowed="a history.nc of panelsim",
            remedy="make the run by itself, with `panelsim run`",
        )
    needed = [f"/{name}" for name in (*SIGNAL_UNITS, "wave_elevation")] + ["/mesh/vertices", "/mesh/panels"]
    needed += [f"/loading/{name}" for name in LOADING_UNITS] + [f"/seaway/{name}" for name in COMPONENT_UNITS]
    missing = sorted(set(needed) - {name for name, _ in _arrays(tree)})
    if missing:
        raise PanelsimError("The history lacks variables", got=f"{path} without {', '.join(missing)}")
