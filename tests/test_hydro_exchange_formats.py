"""Databases of other programs: each format written from one Capytaine solution, and read back."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import capytaine as cpt
import h5py
import numpy as np
import pytest
import xarray as xr
from capytaine.io.wamit import export_wamit_1, export_wamit_3, export_wamit_3fk, export_wamit_3sc

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hull.form import load_hull
from panelsim.hydro import bem
from panelsim.hydro.bem import solve_radiation
from panelsim.hydro.conditioning import pair_scale
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.exchange.bemio import read_bemio
from panelsim.hydro.exchange.capytaine_dataset import read_capytaine
from panelsim.hydro.exchange.hdb import read_hdb
from panelsim.hydro.exchange.wamit import read_wamit
from panelsim.hydro.memory import memory_functions
from panelsim.ship.ship import Ship

DENSITY, GRAVITY = 1025.0, 9.80665
# Radiation reaches to where the memory needs it, waves to where the coarse panels follow them.
WAVES = np.array([0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
FREQUENCIES = np.array([0.1, *WAVES, 1.15, 1.3, 1.45, 1.6, 1.75, 1.9, 2.05, 2.2, 2.4])
DIRECTIONS_DEG = np.array([0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0])
ORIGIN_BEHIND_CG, ABOUT = 12.0, (20.0, 0.0, -1.0)  # m: none of it where ours is
DOFS = ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]


@dataclass(frozen=True)
class Elsewhere:
    """A frigate on coarse panels: our database, and Capytaine's dataset in axes 12 m behind the CG."""

    ship: Ship
    database: HydroDatabase
    dataset: xr.Dataset

    @property
    def center_of_gravity(self) -> tuple[float, float, float]:
        return ORIGIN_BEHIND_CG, 0.0, -self.ship.waterline

    @property
    def places(self) -> dict[str, Any]:
        return {"forward": "+x", "center_of_gravity": self.center_of_gravity, "moments_about": ABOUT}


@pytest.fixture(scope="module")
def elsewhere() -> Elsewhere:
    mesh = load_hull("frigate").panel(10.0)
    ship = Ship(mesh, draft=4.2, center_of_gravity=(None, 0.0, 6.0), gyradii=(4.8, 30.0, 30.0))
    water = {"water_density": DENSITY, "gravity": GRAVITY}
    ours = solve_radiation(
        ship.vertices, mesh.panels, ship.waterline, frequencies=np.append(0.0, FREQUENCIES), **water
    )
    with bem._quiet_single_threaded_capytaine() as capytaine:
        half, _, _ = bem._wet_hull(capytaine, ship.vertices, mesh.panels, ship.waterline)
        hull, lid = (
            cpt.ReflectionSymmetricMesh(half=part.translated_x(ORIGIN_BEHIND_CG), plane="xOz")
            for part in (half, half.generate_lid(z=0.0))
        )
        body = cpt.FloatingBody(
            mesh=hull,
            lid_mesh=lid,
            dofs=cpt.rigid_body_dofs(rotation_center=ABOUT),
            center_of_mass=(ORIGIN_BEHIND_CG, 0.0, -ship.waterline),
        )
        common = {"body": body, "rho": DENSITY, "g": GRAVITY}
        problems = [
            *(
                cpt.RadiationProblem(omega=omega, radiating_dof=dof, **common)
                for omega in (0.0, *FREQUENCIES, np.inf)
                for dof in body.dofs
            ),
            *(
                cpt.DiffractionProblem(omega=omega, wave_direction=direction, **common)
                for omega in WAVES
                for direction in np.radians(DIRECTIONS_DEG)
            ),
        ]
        solver = cpt.BEMSolver(method="direct")
        solved = [solver.solve(problem, _check_wavelength=False) for problem in problems]
        dataset = cpt.assemble_dataset(solved)
    return Elsewhere(ship, HydroDatabase.of_ship(ship, ours), dataset)


def require_same_matrices(read: HydroDatabase, database: HydroDatabase, digits: float) -> None:
    """A and B within `digits` of the peaks, at frequencies 0 and up."""
    assert read.frequencies == pytest.approx(database.frequencies, rel=1e-6)
    for theirs, ours in (
        (read.added_mass, database.added_mass),
        (read.radiation_damping, database.radiation_damping),
        (read.added_mass_infinite[None], database.added_mass_infinite[None]),
    ):
        scale = pair_scale(ours, database.half_breadth)
        assert (np.abs(theirs - ours) / scale).max() < digits


def require_same_loads(read: HydroDatabase, other: HydroDatabase, allowed: float) -> None:
    """Diffraction at rest at every wave, of the largest force and the largest moment."""
    for heading in np.radians([*DIRECTIONS_DEG, -30.0, -90.0, -150.0]):
        theirs, ours = (diffraction_load(d, WAVES, np.array([heading]), 0.0) for d in (read, other))
        scale = np.repeat([np.abs(ours[:, :3]).max(), np.abs(ours[:, 3:]).max()], 3)
        assert (np.abs(theirs - ours) / scale).max() < allowed


# --- Capytaine


@pytest.fixture(scope="module")
def read(elsewhere: Elsewhere) -> HydroDatabase:
    return read_capytaine(elsewhere.dataset, elsewhere.ship, forward="+x")


def test_capytaine_dataset_in_other_axes_gives_our_coefficients(
    elsewhere: Elsewhere, read: HydroDatabase
) -> None:
    """The same solver and panels: only moving from one point to another separates them, by rounding."""
    require_same_matrices(read, elsewhere.database, 1e-9)
    # Green's identity on coarse panels misses the direct solution by 1.6 %; any sign misses by 200 %.
    require_same_loads(read, elsewhere.database, 0.02)
    assert not read.has_potentials and elsewhere.database.has_potentials
    read.require_for(elsewhere.ship)


def test_capytaine_file_is_the_dataset(elsewhere: Elsewhere, read: HydroDatabase, tmp_path: Path) -> None:
    cpt.export_dataset(tmp_path / "frigate.nc", elsewhere.dataset)
    again = read_capytaine(tmp_path / "frigate.nc", elsewhere.ship, forward="+x")
    assert np.array_equal(again.added_mass, read.added_mass)
    assert np.array_equal(again.diffraction_table, read.diffraction_table)


def test_database_without_potentials_is_stored_and_read_back(
    elsewhere: Elsewhere, read: HydroDatabase, tmp_path: Path
) -> None:
    read.save(tmp_path / "hydro.nc")
    again = HydroDatabase.load(tmp_path / "hydro.nc")
    assert again.dataset.identical(read.dataset)
    assert again.notes == read.notes and any("other side" in note for note in again.notes)
    with pytest.raises(PanelsimError, match="no radiation potentials"):
        _ = again.potential
    with pytest.raises(PanelsimError, match="no diffraction tables"):
        _ = elsewhere.database.diffraction_table


def test_memory_is_that_of_our_database(elsewhere: Elsewhere, read: HydroDatabase) -> None:
    theirs, ours = memory_functions(read), memory_functions(elsewhere.database)
    peak = np.abs(ours.momentum_kernel).max()
    # Length and breadth, hence the length of memory, are the ship's in one and the mesh's in the other.
    assert theirs.memory_length == pytest.approx(ours.memory_length, rel=0.02)
    assert np.abs(theirs.momentum_kernel[0] - ours.momentum_kernel[0]).max() < 0.01 * peak


def test_bow_at_minus_x_is_turned_about(elsewhere: Elsewhere, read: HydroDatabase) -> None:
    """The same ship seen from axes that look astern: surge, sway, roll and pitch change sign."""
    sign = xr.DataArray(
        [-1.0, -1.0, 1.0, -1.0, -1.0, 1.0], dims="influenced_dof", coords={"influenced_dof": DOFS}
    )
    turned = elsewhere.dataset.copy(deep=True)
    for name in ("added_mass", "radiation_damping"):
        turned[name] = turned[name] * sign * sign.rename(influenced_dof="radiating_dof")
    for name in ("diffraction_force", "Froude_Krylov_force"):
        turned[name] = turned[name] * sign
    turned = turned.assign_coords(wave_direction=turned["wave_direction"] - np.pi).drop_vars(
        "hydrostatic_stiffness"
    )
    x, y, z = elsewhere.center_of_gravity
    about = read_capytaine(
        turned,
        elsewhere.ship,
        forward="-x",
        center_of_gravity=(-x, y, z),
        moments_about=(-ABOUT[0], ABOUT[1], ABOUT[2]),
    )
    assert about.added_mass == pytest.approx(read.added_mass, rel=1e-9, abs=1e-3)
    assert about.diffraction_table == pytest.approx(read.diffraction_table, rel=1e-9, abs=1e-3)


def flipped(dataset: xr.Dataset, dof: str) -> xr.Dataset:
    """The dataset with one motion and its loads the other way round."""
    sign = xr.DataArray(
        [1.0 - 2.0 * (d == dof) for d in DOFS], dims="influenced_dof", coords={"influenced_dof": DOFS}
    )
    changed = dataset.copy(deep=True)
    for name in ("added_mass", "radiation_damping"):
        changed[name] = changed[name] * sign * sign.rename(influenced_dof="radiating_dof")
    for name in ("diffraction_force", "Froude_Krylov_force", "excitation_force"):
        changed[name] = changed[name] * sign
    return changed.drop_vars("hydrostatic_stiffness")


def conjugated(dataset: xr.Dataset) -> xr.Dataset:
    names = ("diffraction_force", "Froude_Krylov_force", "excitation_force")
    return dataset.assign({name: dataset[name].conj() for name in names})


def with_a_gap(dataset: xr.Dataset) -> xr.Dataset:
    load = dataset["diffraction_force"]
    return dataset.assign(diffraction_force=load.where(~((load.omega == 0.5) & (load.wave_direction == 0.0))))


MISTAKES: dict[str, tuple[Callable[[xr.Dataset], xr.Dataset], str]] = {
    "time factor": (conjugated, "180°|Froude-Krylov load of the file is not"),
    "heading sense": (lambda d: d.assign_coords(wave_direction=-d["wave_direction"]), "in (sway|roll|yaw)"),
    "heads for following": (
        lambda d: d.assign_coords(wave_direction=np.pi - d["wave_direction"]),
        "in surge",
    ),
    "degrees": (lambda d: d.assign_coords(wave_direction=np.degrees(d["wave_direction"])), "in degrees"),
    "pitch sign": (lambda d: flipped(d, "Pitch"), "in pitch"),
    "sway sign": (lambda d: flipped(d, "Sway"), "in (sway|roll)"),
    "density": (lambda d: d.assign_coords(rho=1000.0), "1000 kg/m3"),
    "gravity": (lambda d: d.assign_coords(g=9.6), r"9\.6 m/s2"),
    "speed": (lambda d: d.assign_coords(forward_speed=5.0), "forward_speed"),
    "depth": (lambda d: d.assign_coords(water_depth=30.0), "30 m at"),
    "missing load": (lambda d: with_a_gap(d), "0.5 rad/s"),
    "heave and pitch only": (
        lambda d: d.sel(influenced_dof=["Heave", "Pitch"], radiating_dof=["Heave", "Pitch"]),
        "six of one rigid body",
    ),
    "no limits": (lambda d: d.sel(omega=slice(0.05, 2.0)), "at frequency 0"),
    "no diffraction": (lambda d: d.drop_vars("diffraction_force"), "without diffraction_force"),
    "volume": (lambda d: d.assign(disp_mass=1.1 * d["disp_mass"]), "displaced volume"),
    "waterplane": (
        lambda d: d.assign(hydrostatic_stiffness=1.1 * d["hydrostatic_stiffness"]),
        "waterplane area",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_datasets_with_a_mistake_are_refused(elsewhere: Elsewhere, mistake: str) -> None:
    change, words = MISTAKES[mistake]
    with pytest.raises(PanelsimError, match=words):
        read_capytaine(change(elsewhere.dataset), elsewhere.ship, forward="+x")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"forward": "-x"}, "centre of flotation|in surge"),
        ({"forward": "x"}, "forward is not known"),
        ({"center_of_gravity": (ORIGIN_BEHIND_CG, 0.0, 0.0)}, "above calm water"),
        ({"center_of_gravity": (0.0, 0.0, 1.8)}, "centre of flotation"),
        ({"moments_about": (12.0, 0.0, 1.8)}, "centre of flotation|in pitch"),
        ({"moments_about": (12.0, 0.0)}, "three finite numbers"),
        ({"rest": "zero"}, "rest is not known"),
    ],
)
def test_wrong_places_are_refused(elsewhere: Elsewhere, given: dict[str, Any], words: str) -> None:
    with pytest.raises(PanelsimError, match=words):
        read_capytaine(elsewhere.dataset, elsewhere.ship, **({"forward": "+x"} | given))


def test_places_that_are_not_in_the_dataset_are_asked_for(elsewhere: Elsewhere) -> None:
    for name, asked in (("rotation_center", "moments_about"), ("center_of_mass", "center_of_gravity")):
        with pytest.raises(PanelsimError, match=f"does not say {asked}"):
            read_capytaine(elsewhere.dataset.drop_vars(name), elsewhere.ship, forward="+x")


def test_lowest_frequency_stands_for_rest_only_when_told(elsewhere: Elsewhere, read: HydroDatabase) -> None:
    without = elsewhere.dataset.sel(omega=slice(0.05, np.inf))
    lowest = read_capytaine(without, elsewhere.ship, forward="+x", rest="lowest")
    assert np.array_equal(lowest.added_mass_zero, lowest.added_mass[1])
    assert lowest.added_mass[1] == pytest.approx(read.added_mass[1], rel=1e-12, abs=1e-3)
    assert any("0.1 rad/s stands for it" in note for note in lowest.notes)


def test_infinite_added_mass_is_fitted_where_there_is_none(elsewhere: Elsewhere, read: HydroDatabase) -> None:
    without = elsewhere.dataset.sel(omega=slice(0.0, 10.0))
    fitted = read_capytaine(without, elsewhere.ship, forward="+x")
    assert fitted.added_mass_infinite == pytest.approx(
        memory_functions(read).added_mass_infinite, rel=1e-9, abs=1e-3
    )
    scale = pair_scale(read.added_mass, read.half_breadth)
    # Boundary elements and Ogilvie's relation agree to 1-3 % on fine panels, to 4 % on these.
    assert (np.abs(fitted.added_mass_infinite - read.added_mass_infinite) / scale).max() < 0.05
    assert np.abs(fitted.added_mass_infinite - fitted.added_mass[-1]).max() > 0.0
    assert any("Ogilvie" in note for note in fitted.notes)


# --- WAMIT


@pytest.fixture(scope="module")
def exported(elsewhere: Elsewhere, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Capytaine's own export, ULEN 1, periods: .1, .3, .3sc and .3fk; .hst as the WAMIT manual has it."""
    stem = tmp_path_factory.mktemp("wamit") / "frigate"
    export_wamit_1(elsewhere.dataset, f"{stem}.1")
    waves = elsewhere.dataset.sel(omega=WAVES)
    for export, suffix in ((export_wamit_3, "3"), (export_wamit_3sc, "3sc"), (export_wamit_3fk, "3fk")):
        export(waves, f"{stem}.{suffix}")
    write_hst(Path(f"{stem}.hst"), elsewhere, 1.0)
    return stem


@pytest.fixture
def wamit(exported: Path, tmp_path: Path) -> Path:
    """A copy of these files that a test may damage."""
    shutil.copytree(exported.parent, tmp_path, dirs_exist_ok=True)
    return tmp_path / exported.name


def write_hst(path: Path, elsewhere: Elsewhere, length: float) -> None:
    stiffness = elsewhere.dataset["hydrostatic_stiffness"].values / (DENSITY * GRAVITY)
    power = 2.0 + np.add.outer(np.arange(6) > 2, np.arange(6) > 2)
    rows = stiffness / length**power
    path.write_text("".join(f"{i + 1:6d}{j + 1:6d} {rows[i, j]:14.6E}\n" for i in range(6) for j in range(6)))


def scaled(stem: Path, length: float) -> None:
    """The same files with another ULEN, frequencies in the first column, and a header."""
    for suffix in ("1", "3sc", "3fk"):
        path = Path(f"{stem}.{suffix}")
        lines = ["another program, with a header\n"]
        for line in path.read_text().splitlines():
            row = [float(word) for word in line.split()]
            first = {-1.0: 0.0, 0.0: -1.0}.get(row[0], 2.0 * np.pi / row[0] if row[0] > 0.0 else 0.0)
            rotations = [value > 3 for value in row[1:3]] if suffix == "1" else [row[2] > 3]
            power = sum(rotations) + (3.0 if suffix == "1" else 2.0)
            values = row[3:]
            columns = range(len(values)) if suffix == "1" else (0, 2, 3)
            for column in columns:
                values[column] /= length**power
            middle = f"{row[1]:14.6E} {row[2]:5.0f}" if suffix != "1" else f"{row[1]:5.0f} {row[2]:5.0f}"
            lines.append(f"{first:14.6E} {middle} " + " ".join(f"{value:14.6E}" for value in values) + "\n")
        path.write_text("".join(lines))


def read_ulen_1(stem: Path, elsewhere: Elsewhere, **given: Any) -> HydroDatabase:
    arguments: dict[str, Any] = {"length_scale": 1.0, "water_depth": np.inf, **elsewhere.places}
    return read_wamit(stem, elsewhere.ship, **(arguments | given))


def test_wamit_files_give_what_the_dataset_gives(
    elsewhere: Elsewhere, read: HydroDatabase, wamit: Path
) -> None:
    there = read_ulen_1(wamit, elsewhere)
    # Seven digits in the files; damping comes about the CG from another point, as differences of products.
    require_same_matrices(there, read, 3e-5)
    require_same_loads(there, read, 1e-5)


def test_wamit_length_scale_and_frequencies_for_periods(
    elsewhere: Elsewhere, read: HydroDatabase, wamit: Path
) -> None:
    scaled(wamit, 40.0)
    write_hst(wamit.with_suffix(".hst"), elsewhere, 40.0)
    wamit.with_suffix(".3").unlink()
    there = read_ulen_1(wamit.with_suffix(".1"), elsewhere, length_scale=40.0, first_column="frequency")
    require_same_matrices(there, read, 3e-5)
    require_same_loads(there, read, 1e-5)


def test_wamit_sum_of_loads_has_our_froude_krylov_taken_off(
    elsewhere: Elsewhere, read: HydroDatabase, wamit: Path
) -> None:
    for suffix in (".3sc", ".3fk"):
        wamit.with_suffix(suffix).unlink()
    there = read_ulen_1(wamit, elsewhere)
    # One point a panel there, exact for quadratics here: 1 % of the incident force.
    require_same_loads(there, read, 0.02)
    assert any("taken off" in note for note in there.notes)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"length_scale": 2.0}, "waterplane area"),
        ({"length_scale": 0.0}, "ULEN"),
        ({"first_column": "frequency"}, "in heave"),
        ({"first_column": "omega"}, "first_column is not known"),
        ({"forward": "-x"}, "centre of flotation"),
        ({"water_depth": 20.0}, "not deep"),
        ({"water_depth": -1.0}, "not positive"),
        ({"moments_about": None}, "does not say moments_about"),
    ],
)
def test_wamit_with_wrong_words_is_refused(
    elsewhere: Elsewhere, wamit: Path, given: dict[str, Any], words: str
) -> None:
    with pytest.raises(PanelsimError, match=words):
        read_ulen_1(wamit, elsewhere, **given)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"length_scale": 2.0}, "in heave"),
        ({"length_scale": 0.5}, "in heave"),
        ({"forward": "-x"}, "in pitch"),
        ({"first_column": "frequency"}, "No wave of the file is long"),
    ],
)
def test_sum_of_loads_alone_still_tells_the_hull(
    elsewhere: Elsewhere, wamit: Path, given: dict[str, Any], words: str
) -> None:
    """No hydrostatics and no Froude-Krylov in the files: long waves say whose loads they are."""
    for suffix in (".3sc", ".3fk", ".hst"):
        wamit.with_suffix(suffix).unlink()
    with pytest.raises(PanelsimError, match=words):
        read_ulen_1(wamit, elsewhere, **given)


def test_long_waves_tell_time_factor_and_heading_of_a_sum(elsewhere: Elsewhere, wamit: Path) -> None:
    for suffix in (".3sc", ".3fk", ".hst"):
        wamit.with_suffix(suffix).unlink()
    path = wamit.with_suffix(".3")
    rows = [[float(word) for word in line.split()] for line in path.read_text().splitlines()]

    def write(change: Callable[[list[float]], list[float]]) -> None:
        path.write_text("".join(" ".join(f"{v:.6E}" for v in change(row)) + "\n" for row in rows))

    write(lambda r: [*r[:4], -r[4], r[5], -r[6]])
    with pytest.raises(PanelsimError, match=r"in (surge|sway)"):
        read_ulen_1(wamit, elsewhere)
    write(lambda r: [r[0], -r[1], *r[2:]])
    with pytest.raises(PanelsimError, match="in sway"):
        read_ulen_1(wamit, elsewhere)


def damaged(path: Path, change: Callable[[list[str]], list[str]]) -> None:
    path.write_text("".join(change(path.read_text().splitlines(keepends=True))))


@pytest.mark.parametrize(
    ("suffix", "change", "words"),
    [
        (".1", lambda lines: [*lines[:-1], lines[-1][:20] + "\n"], "cut short or damaged in line"),
        (".1", lambda lines: [*lines[:-1], lines[-1][:37] + "\n"], "no damping"),
        (".1", lambda lines: [*lines[:-1], lines[-1].rstrip()], "last line not ended"),
        (".1", lambda lines: lines[:-3], "do not have the same motions"),
        (".1", lambda lines: [*lines, lines[-1]], "comes twice"),
        (".1", lambda lines: [line for line in lines if line.split()[1:3] != ["5", "5"]], "without pitch"),
        (".1", lambda lines: [lines[0], "header\n", *lines[1:]], "line 2"),
        (".1", lambda lines: [*lines[:-1], lines[-1].replace("e+", "*+")], "damaged"),
        (".1", lambda lines: [*lines[:-1], lines[-1].replace(lines[-1].split()[3], "NaN")], "damaged"),
        (".1", lambda lines: [], "empty"),
        (".1", lambda lines: [*lines, lines[-1].replace("    6", "   12")], "more than one rigid body"),
        (".3sc", lambda lines: lines[:-6], "none at|every motion"),
        (".3sc", lambda lines: lines[:-5], "same motions"),
        (".3sc", lambda lines: lines[42:], "other frequencies"),
        (
            ".3sc",
            lambda lines: [" ".join([*x.split()[:5], *x.split()[:4:-1]]) + "\n" for x in lines],
            "Modulus",
        ),
    ],
)
def test_damaged_wamit_files_are_refused(
    elsewhere: Elsewhere, wamit: Path, suffix: str, change: Callable[[list[str]], list[str]], words: str
) -> None:
    damaged(wamit.with_suffix(suffix), change)
    with pytest.raises(PanelsimError, match=words):
        read_ulen_1(wamit, elsewhere)


def test_missing_wamit_files_are_named(elsewhere: Elsewhere, wamit: Path) -> None:
    for suffix in (".3", ".3sc"):
        wamit.with_suffix(suffix).unlink()
    with pytest.raises(PanelsimError, match="no wave loads"):
        read_ulen_1(wamit, elsewhere)
    wamit.with_suffix(".1").unlink()
    with pytest.raises(PanelsimError, match=r"frigate\.1"):
        read_ulen_1(wamit, elsewhere)


def test_wamit_leaves_out_what_symmetry_makes_zero(
    elsewhere: Elsewhere, read: HydroDatabase, wamit: Path
) -> None:
    damaged(
        wamit.with_suffix(".1"),
        lambda lines: [x for x in lines if (int(x.split()[1]) + int(x.split()[2])) % 2 == 0],
    )
    require_same_matrices(read_ulen_1(wamit, elsewhere), read, 3e-5)


# --- HDF5


def ordered(elsewhere: Elsewhere, name: str, *dims: str) -> FloatArray:
    """A variable at the wave frequencies with its dimensions in this order."""
    return elsewhere.dataset[name].sel(omega=WAVES).transpose(*dims).values


def write_bemio(path: Path, elsewhere: Elsewhere, *, divided: bool) -> None:
    """As WEC-Sim's writeBEMIOH5 leaves it from readCAPYTAINE, moments about `cg`."""
    density, force = (DENSITY, DENSITY * GRAVITY) if divided else (1.0, 1.0)
    matrix, waves = (
        ("influenced_dof", "radiating_dof", "omega"),
        ("influenced_dof", "wave_direction", "omega"),
    )
    with h5py.File(path, "w") as file:
        simulation, body = file.create_group("simulation_parameters"), file.create_group("body1")
        simulation["scaled"] = [[0.0 if divided else 1.0]]
        simulation["g"], simulation["rho"] = [[GRAVITY]], [[DENSITY]]
        simulation["w"], simulation["water_depth"] = WAVES[:, None], b"infinite"
        simulation["wave_dir"] = DIRECTIONS_DEG[:, None]
        simulation["wave_dir"].attrs["units"] = "deg"
        body["properties/cg"], body["properties/disp_vol"] = (
            np.array(ABOUT)[:, None],
            [[elsewhere.ship.mass / DENSITY]],
        )
        body["hydro_coeffs/linear_restoring_stiffness"] = (
            elsewhere.dataset["hydrostatic_stiffness"].values / force
        )
        body["hydro_coeffs/added_mass/all"] = ordered(elsewhere, "added_mass", *matrix) / density
        body["hydro_coeffs/added_mass/inf_freq"] = (
            elsewhere.dataset["added_mass"].sel(omega=np.inf).values / density
        )
        damping = ordered(elsewhere, "radiation_damping", *matrix)
        body["hydro_coeffs/radiation_damping/all"] = damping / (DENSITY * WAVES) if divided else damping
        for name, place in (
            ("excitation_force", ""),
            ("diffraction_force", "/scattering"),
            ("Froude_Krylov_force", "/froude-krylov"),
        ):
            load = ordered(elsewhere, name, *waves) / force
            body[f"hydro_coeffs/excitation{place}/re"] = load.real
            body[f"hydro_coeffs/excitation{place}/im"] = -load.imag


def write_hdb(path: Path, elsewhere: Elsewhere, *, version: float) -> None:
    """As FRyDoM's writers leave it, exp(-iωt)."""
    with h5py.File(path, "w") as file:
        file["Version"], file["NbBody"], file["WaterDepth"] = version, 1, 0.0
        file["WaterDensity"], file["GravityAcc"] = DENSITY, GRAVITY
        body = file.create_group("Bodies/Body_0")
        grid = file.create_group("Discretizations")
        if version >= 3.0:
            grid["Frequency"], grid["WaveDirection"] = WAVES, DIRECTIONS_DEG
            body["BodyPosition"] = ABOUT
        else:
            names = ("Frequency", "MinFrequency", "MaxFrequency", "NbFrequencies"), WAVES
            angles = ("WaveDirections", "MinAngle", "MaxAngle", "NbWaveDirections"), DIRECTIONS_DEG
            for (group, lowest, highest, count), values in (names, angles):
                grid[f"{group}/{lowest}"], grid[f"{group}/{highest}"] = values[0], values[-1]
                grid[f"{group}/{count}"] = len(values)
            for kind in ("Force", "Motion"):
                for mode in (3, 4, 5):
                    body[f"Modes/{kind}Modes/Mode_{mode}/Point"] = ABOUT
        body["Hydrostatic/StiffnessMatrix"] = elsewhere.dataset["hydrostatic_stiffness"].values
        radiation = body.create_group("Radiation/BodyMotion_0")
        radiation["InfiniteAddedMass"] = elsewhere.dataset["added_mass"].sel(omega=np.inf).values
        for name, place in (("added_mass", "AddedMass"), ("radiation_damping", "RadiationDamping")):
            values = ordered(elsewhere, name, "radiating_dof", "influenced_dof", "omega")
            for motion in range(6):
                radiation[f"{place}/DOF_{motion}"] = values[motion]
        for name, place in (("diffraction_force", "Diffraction"), ("Froude_Krylov_force", "FroudeKrylov")):
            load = ordered(elsewhere, name, "wave_direction", "influenced_dof", "omega")
            for i, angle in enumerate(DIRECTIONS_DEG):
                group = body.create_group(f"Excitation/{place}/Angle_{i}")
                group["Angle"], group["RealCoeffs"], group["ImagCoeffs"] = angle, load[i].real, load[i].imag


def same_at_waves(there: HydroDatabase, read: HydroDatabase) -> None:
    """A, B and the tables of the wave frequencies to rounding: both formats hold double precision."""
    kept = np.isin(np.round(read.frequencies, 9), np.round(WAVES, 9))
    scale = pair_scale(read.added_mass, read.half_breadth)
    assert (np.abs(there.added_mass[1:] - read.added_mass[kept]) / scale).max() < 1e-12
    scale = pair_scale(read.radiation_damping, read.half_breadth)
    assert (np.abs(there.radiation_damping[1:] - read.radiation_damping[kept]) / scale).max() < 1e-12
    assert there.diffraction_table == pytest.approx(read.diffraction_table, rel=1e-12, abs=1e-3)


@pytest.mark.parametrize("divided", [True, False])
def test_bemio_file_gives_what_the_dataset_gives(
    elsewhere: Elsewhere, read: HydroDatabase, tmp_path: Path, divided: bool
) -> None:
    path = tmp_path / "frigate.h5"
    write_bemio(path, elsewhere, divided=divided)
    there = read_bemio(
        path, elsewhere.ship, forward="+x", center_of_gravity=elsewhere.center_of_gravity, rest="lowest"
    )
    same_at_waves(there, read)


def test_bemio_without_parts_takes_our_froude_krylov_off(
    elsewhere: Elsewhere, read: HydroDatabase, tmp_path: Path
) -> None:
    """BEMIO of WAMIT without .3sc and .3fk: the parts are there, and NaN."""
    path = tmp_path / "frigate.h5"
    write_bemio(path, elsewhere, divided=True)
    with h5py.File(path, "a") as file:
        for part in ("scattering", "froude-krylov"):
            for half in ("re", "im"):
                file[f"body1/hydro_coeffs/excitation/{part}/{half}"][...] = np.nan
    there = read_bemio(
        path, elsewhere.ship, forward="+x", center_of_gravity=elsewhere.center_of_gravity, rest="lowest"
    )
    require_same_loads(there, read, 0.02)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda f: f.create_group("body2"), "more than one body"),
        (lambda f: f.__delitem__("simulation_parameters/scaled"), "divided by density"),
        (lambda f: f["simulation_parameters/scaled"].__setitem__(..., 1.0), "waterplane"),
        (lambda f: f["simulation_parameters/wave_dir"].attrs.__setitem__("units", ""), "have no unit"),
        (lambda f: f["simulation_parameters/wave_dir"].attrs.__setitem__("units", "rad"), "in degrees"),
        (lambda f: f.__delitem__("body1/hydro_coeffs/added_mass/all"), "added_mass/all"),
        (lambda f: f["body1/hydro_coeffs/excitation/re"].__setitem__((2, 0, 3), np.nan), "heave at 0.5"),
        (lambda f: f["simulation_parameters/w"].__setitem__(3, 0.4), "do not rise"),
        (lambda f: f["body1/properties/cg"].__setitem__(..., 0.0), "centre of flotation|pitch"),
        (
            lambda f: f["body1/hydro_coeffs/excitation/froude-krylov/im"].__setitem__(..., 0.0),
            "Froude-Krylov",
        ),
    ],
)
def test_damaged_bemio_files_are_refused(
    elsewhere: Elsewhere, tmp_path: Path, change: Callable[[Any], Any], words: str
) -> None:
    path = tmp_path / "frigate.h5"
    write_bemio(path, elsewhere, divided=True)
    with h5py.File(path, "a") as file:
        change(file)
    with pytest.raises(PanelsimError, match=words):
        read_bemio(
            path, elsewhere.ship, forward="+x", center_of_gravity=elsewhere.center_of_gravity, rest="lowest"
        )


@pytest.mark.parametrize("version", [2.0, 3.0])
def test_hdb_file_gives_what_the_dataset_gives(
    elsewhere: Elsewhere, read: HydroDatabase, tmp_path: Path, version: float
) -> None:
    path = tmp_path / "frigate.hdb5"
    write_hdb(path, elsewhere, version=version)
    there = read_hdb(
        path, elsewhere.ship, forward="+x", center_of_gravity=elsewhere.center_of_gravity, rest="lowest"
    )
    same_at_waves(there, read)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda f: f["NbBody"].__setitem__((), 2), "more than one body"),
        (lambda f: f.__delitem__("Discretizations/Frequency/NbFrequencies"), "NbFrequencies"),
        (lambda f: f["Discretizations/Frequency/NbFrequencies"].__setitem__((), 8), "is not whole"),
        (
            lambda f: f["Bodies/Body_0/Excitation/Diffraction/Angle_2/Angle"].__setitem__((), 61.0),
            "do not agree",
        ),
        (lambda f: f.__delitem__("Bodies/Body_0/Modes"), "does not say moments_about"),
        (lambda f: f["WaterDensity"].__setitem__((), 1000.0), "1000 kg/m3"),
        (lambda f: f["WaterDepth"].__setitem__((), 25.0), "not deep"),
        (
            lambda f: f["Bodies/Body_0/Radiation/BodyMotion_0/AddedMass/DOF_1"].__setitem__(..., 0.0),
            "not symmetric",
        ),
    ],
)
def test_damaged_hdb_files_are_refused(
    elsewhere: Elsewhere, tmp_path: Path, change: Callable[[Any], Any], words: str
) -> None:
    path = tmp_path / "frigate.hdb5"
    write_hdb(path, elsewhere, version=2.0)
    with h5py.File(path, "a") as file:
        change(file)
    with pytest.raises(PanelsimError, match=words):
        read_hdb(
            path, elsewhere.ship, forward="+x", center_of_gravity=elsewhere.center_of_gravity, rest="lowest"
        )


def test_files_cut_short_and_no_files_are_refused(elsewhere: Elsewhere, tmp_path: Path) -> None:
    path = tmp_path / "frigate"
    places: dict[str, Any] = {"forward": "+x", "center_of_gravity": elsewhere.center_of_gravity}
    for reader in (read_capytaine, read_bemio, read_hdb):
        with pytest.raises(PanelsimError, match="cannot be read"):
            reader(path, elsewhere.ship, **places)
    write_bemio(path, elsewhere, divided=True)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    for reader in (read_capytaine, read_bemio, read_hdb):
        with pytest.raises(PanelsimError, match="cannot be read"):
            reader(path, elsewhere.ship, **places)
