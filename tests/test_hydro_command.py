"""`panelsim hydro`: coefficients computed or read from elsewhere, and a case that runs on them.

Files from elsewhere are those of Capytaine itself, its dataset and its WAMIT export; HDF5 is written here.
"""

import re
from collections.abc import Callable
from pathlib import Path

import capytaine as cpt
import h5py
import numpy as np
import pytest
import xarray as xr
from capytaine.io.wamit import export_to_wamit

import panelsim as ps
from panelsim.hydro import bem

Call = Callable[..., tuple[int, str, str]]
AHEAD, ABOUT = 3.0, (1.0, 0.0, -1.0)  # m: the CG and the point of moments in the axes of the files
AXES = ("--forward", "+x")
CG = ("--center-of-gravity", f"{AHEAD},0,0")
POINT = ("--moments-about", ",".join(map(str, ABOUT)))
WAMIT = (*AXES, *CG, *POINT, "--length-scale", "1", "--water-depth", "inf")
WAVES = np.linspace(0.5, 2.5, 9)  # rad/s
# To where the damping of the box has died, so that a run can be made of it.
FREQUENCIES = np.append(np.arange(2, 37) / 8.0, 5.0)
DIRECTIONS_DEG = np.array([0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0])


@pytest.fixture
def call(panelsim: Call) -> Call:
    """Call `panelsim`: exit code, output and errors in one line each."""

    def called(*arguments: object) -> tuple[int, str, str]:
        code, out, err = panelsim(*arguments)
        return code, " ".join(out.split()), " ".join(err.split())

    return called


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """box.nc and the folder wamit/ by Capytaine, box-bemio.h5 and box-hdb.h5 written from its dataset."""
    folder = tmp_path_factory.mktemp("elsewhere")
    whole = solved()
    # The last frequency is one too much for these panels.
    cpt.export_dataset(folder / "coarse.nc", whole)
    dataset = whole.sel(omega=whole["omega"] != FREQUENCIES[-1])
    cpt.export_dataset(folder / "box.nc", dataset)
    (folder / "wamit").mkdir()
    export_to_wamit(dataset, str(folder / "wamit" / "box"), exports=("1", "3", "3fk", "3sc", "hst"))
    write_bemio(folder / "box-bemio.h5", dataset)
    write_hdb(folder / "box-hdb.h5", dataset)
    return folder


def solved() -> xr.Dataset:
    """The box by Capytaine as a user of it would, with its CG `AHEAD` of the origin."""
    ship = ps.load_ship("box", panel_area=0.8)
    with bem._quiet_single_threaded_capytaine():
        half, _, _ = bem._wet_hull(cpt, ship.vertices, ship.mesh.panels, ship.waterline)
        hull, lid = (
            cpt.ReflectionSymmetricMesh(half=part.translated_x(AHEAD), plane="xOz")
            for part in (half, half.generate_lid(z=0.0))
        )
        body = cpt.FloatingBody(
            mesh=hull,
            lid_mesh=lid,
            dofs=cpt.rigid_body_dofs(rotation_center=ABOUT),
            center_of_mass=(AHEAD, 0.0, -ship.waterline),
        )
        water = {"rho": ship.water_density, "g": ship.gravity}
        body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness(**water)
        common = {"body": body, **water}
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
        return cpt.assemble_dataset([solver.solve(each, _check_wavelength=False) for each in problems])


def ordered(dataset: xr.Dataset, name: str, *dims: str) -> np.ndarray:
    return dataset[name].sel(omega=WAVES).transpose(*dims).values


def write_bemio(path: Path, dataset: xr.Dataset) -> None:
    """With dimensions (scaled = 1) and loads in exp(+iωt), as WEC-Sim leaves it."""
    matrix = ("influenced_dof", "radiating_dof", "omega")
    with h5py.File(path, "w") as file:
        simulation, body = file.create_group("simulation_parameters"), file.create_group("body1")
        simulation["scaled"], simulation["g"], simulation["rho"] = 1.0, dataset["g"], dataset["rho"]
        simulation["w"], simulation["wave_dir"] = WAVES, DIRECTIONS_DEG
        simulation["water_depth"] = b"infinite"
        simulation["wave_dir"].attrs["units"] = "deg"
        body["properties/cg"], body["properties/disp_vol"] = ABOUT, ps.load_ship("box").mass / dataset["rho"]
        body["hydro_coeffs/linear_restoring_stiffness"] = dataset["hydrostatic_stiffness"].values
        body["hydro_coeffs/added_mass/all"] = ordered(dataset, "added_mass", *matrix)
        body["hydro_coeffs/added_mass/inf_freq"] = dataset["added_mass"].sel(omega=np.inf).values
        body["hydro_coeffs/radiation_damping/all"] = ordered(dataset, "radiation_damping", *matrix)
        for name, place in (
            ("excitation_force", ""),
            ("diffraction_force", "/scattering"),
            ("Froude_Krylov_force", "/froude-krylov"),
        ):
            load = ordered(dataset, name, "influenced_dof", "wave_direction", "omega")
            body[f"hydro_coeffs/excitation{place}/re"] = load.real
            body[f"hydro_coeffs/excitation{place}/im"] = -load.imag


def write_hdb(path: Path, dataset: xr.Dataset) -> None:
    """Version 3, loads in exp(-iωt)."""
    with h5py.File(path, "w") as file:
        file["Version"], file["NbBody"], file["WaterDepth"] = 3.0, 1, 0.0
        file["WaterDensity"], file["GravityAcc"] = dataset["rho"], dataset["g"]
        grid, body = file.create_group("Discretizations"), file.create_group("Bodies/Body_0")
        grid["Frequency"], grid["WaveDirection"], body["BodyPosition"] = WAVES, DIRECTIONS_DEG, ABOUT
        radiation = body.create_group("Radiation/BodyMotion_0")
        radiation["InfiniteAddedMass"] = dataset["added_mass"].sel(omega=np.inf).values
        for name, place in (("added_mass", "AddedMass"), ("radiation_damping", "RadiationDamping")):
            values = ordered(dataset, name, "radiating_dof", "influenced_dof", "omega")
            for motion in range(6):
                radiation[f"{place}/DOF_{motion}"] = values[motion]
        for name, place in (("diffraction_force", "Diffraction"), ("Froude_Krylov_force", "FroudeKrylov")):
            load = ordered(dataset, name, "wave_direction", "influenced_dof", "omega")
            for i, angle in enumerate(DIRECTIONS_DEG):
                group = body.create_group(f"Excitation/{place}/Angle_{i}")
                group["Angle"], group["RealCoeffs"], group["ImagCoeffs"] = angle, load[i].real, load[i].imag


@pytest.mark.parametrize(
    ("file", "words", "rest"),
    [
        ("box.nc", AXES, "file"),
        ("wamit", WAMIT, "file"),
        ("wamit/box.1", WAMIT, "file"),
        ("wamit/box.3", WAMIT, "file"),
        ("box-bemio.h5", (*AXES, *CG), "lowest"),
        ("box-hdb.h5", (*AXES, *CG), "lowest"),
    ],
)
def test_every_kind_of_file_becomes_a_database_of_the_ship(
    call: Call, files: Path, file: str, words: tuple[str, ...], rest: str
) -> None:
    """Against coefficients of our own on other panels; a wrong sign, axis or unit is off by 100 % or more."""
    code, out, err = call("hydro", "box", "--from", files / file, *words, "--rest", rest, "-o", "there.nc")
    assert (code, err) == (0, "")
    assert "0.5 to 2.5 rad/s (9 stored)" in out
    assert "Headings: -150, -120, -90, -60, -30, 0, 30, 60, 90, 120, 150, 180°" in out
    ship = ps.load_ship("box")
    there, ours = ps.HydroDatabase.load("there.nc"), ps.database_for(ship)
    there.require_for(ship)
    omega, heading = np.array([0.75, 1.0, 1.25, 1.5]), np.deg2rad(60.0)
    theirs, own = (ps.diffraction_load(d, omega, heading, 0.0) for d in (there, ours))
    peak = np.repeat([np.abs(own[:, :3]).max(), np.abs(own[:, 3:]).max()], 3)
    # Panels of 0.8 m² on a box with sharp edges lose some per cent.
    assert np.abs((theirs - own) / peak).max() < 0.08
    scale = np.sqrt(np.abs(np.outer(*2 * [np.diag(ours.added_mass_infinite)])))
    assert np.abs((there.added_mass_infinite - ours.added_mass_infinite) / scale).max() < 0.08
    if rest == "lowest":
        assert "The file has no added mass at frequency 0: that of 0.5 rad/s" in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("box.nc",), "A file of Capytaine does not say forward."),
        (("wamit", *AXES, *CG), "does not say moments_about, length_scale, water_depth"),
        (("box-hdb.h5", *AXES), "A file of HDB5 does not say center_of_gravity"),
        (("box.nc", *AXES, "--length-scale", "1"), "has no use for length_scale"),
        (("box.nc", "--forward", "x"), "forward is not known"),
        (("box.nc", *AXES, "--center-of-gravity", "1,2"), "--center-of-gravity is no point"),
        (("box.nc", *AXES, "--center-of-gravity", "0,0,0"), "centre of flotation"),
        (("box.nc", *AXES, "--rest", "highest"), "rest is not known"),
        (("box.nc", *AXES, "--method", "bem"), "either read or computed"),
        (("wamit", *WAMIT[:-4], "--length-scale", "2", *WAMIT[-2:]), "waterplane area"),
        (("wamit", *WAMIT[:-1], "12"), "not deep"),
        (("wamit", *WAMIT, "--first-column", "frequency"), "Froude-Krylov"),
        (("box-bemio.h5", *AXES, *CG), "no added mass at frequency 0"),
        (("none.nc", *AXES), "no such file or folder"),
        ((".", *WAMIT), "files of one WAMIT run"),
        (("coarse.nc", *AXES), "good to 4.5 rad/s"),
    ],
)
def test_what_a_file_does_not_say_is_asked_for_and_what_is_wrong_refused(
    call: Call, files: Path, tmp_path: Path, arguments: tuple[str, ...], words: str
) -> None:
    code, _, err = call("hydro", "box", "-o", "new/there.nc", "--from", files / arguments[0], *arguments[1:])
    assert code == 2 and words in err and err.count("error: ") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_file_of_another_ship_or_water_is_refused(call: Call, files: Path, tmp_path: Path) -> None:
    given = ("--from", files / "box.nc", *AXES, "-o", "there.nc")
    code, _, err = call("hydro", "cylinder", *given)
    assert code == 2 and re.search("displaced volume|waterplane|centre of gravity", err)
    code, _, err = call("hydro", write_case(tmp_path, water="water_density = 1000"), *given)
    assert code == 2 and "1025 kg/m3" in err and "1000 kg/m3" in err
    assert not (tmp_path / "there.nc").exists()


def test_files_that_are_none_are_refused(call: Call, tmp_path: Path) -> None:
    ps.database_for(ps.load_ship("box")).save(tmp_path / "own.nc")
    code, _, err = call("hydro", "box", "--from", "own.nc", *AXES, "-o", "there.nc")
    assert code == 2 and "database of panelsim already" in err and '[hydrodynamics] file = "own.nc"' in err
    whole = (tmp_path / "own.nc").read_bytes()
    for name in ("cut.nc", "cut.h5"):
        (tmp_path / name).write_bytes(whole[: len(whole) // 2])
        code, out, err = call("hydro", "box", "--from", name, *AXES, "-o", "there.nc")
        assert code == 2 and f"got: {name} (" in err and "cannot be read" in err and out == ""
    for name, words in (("text.txt", "no database of a program"), ("text.nc", "got: text.nc what to do")):
        (tmp_path / name).write_text("text")
        code, _, err = call("hydro", "box", "--from", name, *AXES, "-o", "there.nc")
        assert code == 2 and words in err
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["something"] = 1.0
    code, _, err = call("hydro", "box", "--from", "other.h5", *AXES, "-o", "there.nc")
    assert code == 2 and "no database of a program" in err
    code, _, err = call("hydro", "box", *AXES, "-o", "there.nc")
    assert code == 2 and "without --from" in err and "--forward" in err
    assert not (tmp_path / "there.nc").exists()


def case_text(**keys: str) -> str:
    return f"""
[ship]
hull = "box"
{keys.get("water", "")}
[hydrodynamics]
{keys.get("file", "")}
[seaway]
kind = "regular"
wave_height = {keys.get("height", "0.4")}
wave_frequency = {keys.get("frequency", "1.25")}
wave_heading_deg = {keys.get("heading", "150")}
[run]
speed_knots = {keys.get("knots", "0")}
time_step = 0.1
ramp = 5
duration = 10
"""


def write_case(folder: Path, **keys: str) -> Path:
    path = folder / "box.toml"
    path.write_text(case_text(**keys))
    return path


def test_a_case_takes_a_database_from_elsewhere(call: Call, files: Path, tmp_path: Path) -> None:
    """`check` tells what it covers; its motions are those of our own coefficients, on finer panels."""
    assert call("hydro", "box", "--from", files / "box.nc", *AXES, "-o", "there.nc")[0] == 0
    case = write_case(tmp_path, file='file = "there.nc"')
    code, out, _ = call("check", case)
    assert code == 0 and "Source: Capytaine 3" in out and "other waves are refused" in out
    code, out, _ = call(
        "response", case, "-o", "r.nc", "--headings", "0:180:30", "--set", "run.speed_knots=4"
    )
    assert code == 0 and "The diffraction tables hold zero speed" in out
    ship = ps.load_ship("box")
    waves = {"frequencies": [0.75, 1.0, 1.25], "wave_headings": [np.deg2rad(150)], "speeds": [0.0]}
    theirs, ours = (
        ps.response(ship, database, **waves).transfer[0, 0]
        for database in (ps.Case.load(case).database(), ps.database_for(ship))
    )
    for dof in (ps.Dof.SWAY, ps.Dof.HEAVE, ps.Dof.PITCH):
        # Panels of 0.8 m² lose some per cent of the loads; a wrong phase or axis is off by more than 50 %.
        assert np.abs(theirs[:, dof] - ours[:, dof]).max() < 0.1 * np.abs(ours[:, dof]).max()


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"frequency": "3.0"}, "do not hold the frequency of 1 of 1 waves"),
        ({"frequency": "0.3"}, "0.5 to 2.5 rad/s"),
        ({"frequency": "2.4", "heading": "45"}, "do not hold the heading of 1 of 1 waves"),
    ],
)
def test_waves_outside_the_tables_are_refused_by_every_command(
    call: Call, files: Path, tmp_path: Path, keys: dict[str, str], words: str
) -> None:
    assert call("hydro", "box", "--from", files / "box.nc", *AXES, "-o", "there.nc")[0] == 0
    case = write_case(tmp_path, file='file = "there.nc"', **keys)
    for command in (("check", case), ("run", case, "--out", "out"), ("response", case, "-o", "out/r.nc")):
        code, _, err = call(*command)
        assert code == 2 and words in err and err.count("error: ") == 1, command
        assert not (tmp_path / "out").is_dir() or not list((tmp_path / "out").iterdir())
    loaded = ps.Case.load(case)
    with pytest.raises(ps.PanelsimError, match=words):
        ps.simulate(
            loaded.ship, loaded.seaway, speed=0.0, duration=2.0, time_step=0.1, database=loaded.database()
        )


@pytest.mark.parametrize("method", ["bem", "strip"])
def test_a_sea_shorter_than_the_mesh_resolves_is_refused_with_what_it_is_good_to(
    call: Call, tmp_path: Path, method: str
) -> None:
    ship = ps.load_ship("halifax", panel_area=20.0)
    database = ps.database_for(ship) if method == "bem" else ps.HydroDatabase.compute(ship, method)
    last = database.frequencies[-1]
    database.save(tmp_path / "ours.nc")
    text = case_text(file='file = "ours.nc"', frequency=f"{last + 0.1:.3f}", height="0.1")
    case = tmp_path / "short.toml"
    case.write_text(text.replace('hull = "box"', 'hull = "halifax"\npanel_area = 20'))
    for command in (("check", case), ("response", case, "-o", "out/r.nc")):
        code, _, err = call(*command)
        assert code == 2 and f"{last:.4g} rad/s or less" in err and err.count("error: ") == 1
    longer = ("--set", f"seaway.wave_frequency={last - 0.1:.3f}")
    assert call("check", case, *longer)[0] == 0
    loaded = ps.Case.load(case)
    if method == "bem":
        with pytest.raises(ps.PanelsimError, match="100 % of the energy"):
            ps.simulate(loaded.ship, loaded.seaway, speed=0.0, duration=2.0, time_step=0.1, database=database)


def test_coefficients_are_written_to_nc_files_only(call: Call, tmp_path: Path) -> None:
    """A slip of the name must not cost a case, even with --force."""
    (tmp_path / "victim.toml").write_text("mine")
    for name in ("victim.toml", "victim", "new.h5"):
        code, _, err = call("hydro", "box", "-o", name, "--force")
        assert code == 2 and f"got: {name} allowed: a file name in .nc" in err
    assert (tmp_path / "victim.toml").read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["victim.toml"]
