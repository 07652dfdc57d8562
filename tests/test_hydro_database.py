"""The hydrodynamic database: computed for a ship, stored, read back, and refused to another ship."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from panelsim.conventions import STANDARD_GRAVITY
from panelsim.errors import PanelsimError
from panelsim.hull.form import hull_folder, load_hull
from panelsim.hull.refine import subdivided
from panelsim.hydro.bem import highest_resolved_frequency
from panelsim.hydro.database import HydroDatabase, _panelled_for_solution
from panelsim.hydro.frequency_grids import frequency_grid
from panelsim.hydro.memory import memory_functions
from panelsim.hydro.store import STORED_NAME
from panelsim.ship.bundled import load_ship
from panelsim.ship.ship import Ship


def sphere(
    center_of_gravity_height: float = 3.0,
    water_density: float = 1000.0,
    area: float = 2.0,
    gravity: float = STANDARD_GRAVITY,
) -> Ship:
    """A half-submerged sphere of 10 m without a hull form: solved on its own, coarse mesh."""
    return Ship(
        load_hull("sphere").panel(area),
        draft=5.0,
        center_of_gravity=(None, 0.0, center_of_gravity_height),
        gyradii=(2.0, 2.0, 2.0),
        water_density=water_density,
        gravity=gravity,
        name="sphere",
    )


@pytest.fixture(scope="module")
def database() -> HydroDatabase:
    return HydroDatabase.compute(sphere())


def test_axes_are_those_of_the_ship(database: HydroDatabase) -> None:
    """Forces on a sphere pass through its centre, h above the CG: A24 = -A22 h, A15 = A11 h, A44 = A22 h²."""
    height = 5.0 - 3.0
    a = database.added_mass_infinite
    assert database.waterline == pytest.approx(height)
    # 3 % for flat panels.
    assert a[1, 3] == pytest.approx(-a[1, 1] * height, rel=0.03)
    assert a[0, 4] == pytest.approx(a[0, 0] * height, rel=0.03)
    assert a[3, 3] == pytest.approx(a[1, 1] * height**2, rel=0.06)
    # A sphere has none; the edges of this coarse polyhedron, resolved by panels split in four, a little.
    assert abs(a[5, 5]) < 0.01 * a[3, 3]
    smooth = HydroDatabase.load(hull_folder("sphere") / STORED_NAME).added_mass_infinite
    assert abs(smooth[5, 5]) < 1e-5 * smooth[3, 3]


def test_shapes_and_limits(database: HydroDatabase) -> None:
    count, panels = len(database.frequencies), len(database.panel_corners)
    assert database.frequencies[0] == 0.0
    assert database.added_mass.shape == database.radiation_damping.shape == (count, 6, 6)
    assert database.potential.shape == (count, 6, panels)
    assert database.potential_infinite.shape == (6, panels)
    assert np.all(database.radiation_damping[0] == 0.0)
    assert np.array_equal(database.added_mass_zero, database.added_mass[0])


def test_reads_back_what_was_computed_to_the_bit(database: HydroDatabase, tmp_path: Path) -> None:
    path = tmp_path / "new folder" / "hydro.nc"
    database.save(path)
    again = HydroDatabase.load(path)
    assert again.dataset.identical(database.dataset)
    assert [p.name for p in path.parent.iterdir()] == ["hydro.nc"]
    with pytest.raises(PanelsimError, match="overwrite a file"):
        again.save(path)
    assert again.save(str(path), overwrite=True) == path
    assert HydroDatabase.load(path).dataset.identical(database.dataset)


def test_file_says_its_conventions(database: HydroDatabase, tmp_path: Path) -> None:
    database.save(tmp_path / "hydro.nc")
    with xr.open_dataset(tmp_path / "hydro.nc", engine="h5netcdf") as stored:
        assert stored.attrs["time_factor"] == "exp(+i omega t)"
        assert "y to port" in stored.attrs["axes"]
        assert stored.attrs["ship_water_density"] == 1000.0
        assert stored["added_mass"].dims == ("frequency", "influenced_dof", "radiating_dof")
        assert list(stored["influenced_dof"].values)[:3] == ["surge", "sway", "heave"]


def test_belongs_to_its_ship_and_to_no_other(database: HydroDatabase) -> None:
    database.require_for(sphere())
    with pytest.raises(PanelsimError, match="another ship") as caught:
        database.require_for(sphere(center_of_gravity_height=3.5, water_density=1025.0))
    assert "center of gravity z 3 there, 3.5 here" in str(caught.value)
    assert "water density 1000 there, 1025 here" in str(caught.value)
    assert "draft" not in str(caught.value) and "form" not in str(caught.value)
    with pytest.raises(PanelsimError, match=r"gravity 9\.\d+ there, 9\.\d+ here"):
        database.require_for(sphere(gravity=9.81))
    with pytest.raises(PanelsimError, match=r"form \w+ there, \w+ here"):
        database.require_for(sphere(area=5.0))


def test_damaged_missing_and_foreign_files_are_refused(database: HydroDatabase, tmp_path: Path) -> None:
    path = tmp_path / "hydro.nc"
    with pytest.raises(PanelsimError, match="There is no hydrodynamic database"):
        HydroDatabase.load(path)
    database.save(path)
    whole = path.read_bytes()
    for cut in (0, 100, len(whole) // 2, len(whole) - 50):
        path.write_bytes(whole[:cut])
        with pytest.raises(PanelsimError, match="cut short"):
            HydroDatabase.load(path)
    xr.Dataset({"added_mass": ("x", np.zeros(3))}).to_netcdf(path, engine="h5netcdf")
    with pytest.raises(PanelsimError, match="no hydrodynamic database of panelsim"):
        HydroDatabase.load(path)
    for missing in ("potential_real", "added_mass_infinite"):
        database.dataset.drop_vars(missing).to_netcdf(path, engine="h5netcdf")
        with pytest.raises(PanelsimError, match=rf"is not whole\.\n  got: .*hydro\.nc without {missing}\n"):
            HydroDatabase.load(path)


def test_failed_write_leaves_the_old_file(
    database: HydroDatabase, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "hydro.nc"
    path.write_bytes(b"old")

    def full_disk(*_args: object, **_kwargs: object) -> None:
        raise OSError("no space left")

    monkeypatch.setattr(Path, "write_bytes", full_disk)
    with pytest.raises(PanelsimError, match="no space"):
        database.save(path, overwrite=True)
    assert path.read_bytes() == b"old"
    assert len(list(tmp_path.iterdir())) == 1


def test_one_hull_is_solved_on_one_mesh_whatever_mesh_it_comes_with() -> None:
    """Bit for bit, so that a mesh study or a cache never mixes coefficients."""
    one, two = (_panelled_for_solution(load_ship("frigate", panel_area=area)) for area in (2.5, 8.0))
    assert np.array_equal(one.vertices, two.vertices)
    assert np.array_equal(one.mesh.panels, two.mesh.panels)
    assert one.identity() == two.identity()
    wet = one.vertices[one.mesh.panels].mean(axis=1)[:, 2] < one.waterline
    assert 900 < np.count_nonzero(wet) < 1200


def test_unknown_method_is_refused() -> None:
    with pytest.raises(PanelsimError, match="method is not known"):
        HydroDatabase.compute(sphere(), method="magic")


def test_memory_of_a_sphere_passes_its_own_check(database: HydroDatabase) -> None:
    """A blunt body without yaw damping at all: longer memory, and no division by its zero peak."""
    memory = memory_functions(database)
    print(memory.rebuilt_damping.max(), memory.rebuilt_added_mass.max())
    assert memory.rebuilt_damping.max() < 0.01
    assert memory.rebuilt_added_mass.max() < 0.01


def test_grid_goes_with_the_root_of_length_and_ends_where_the_panels_do(database: HydroDatabase) -> None:
    assert frequency_grid(120.0)[[1, -1]] == pytest.approx([0.05, 2.6])
    assert frequency_grid(30.0) == pytest.approx(2.0 * frequency_grid(120.0))
    assert frequency_grid(120.0, 1.3) == pytest.approx(0.5 * frequency_grid(120.0))
    ship = sphere()
    # Its own panels are coarse: they are solved split in four.
    mesh = subdivided(ship.mesh)
    wet = mesh.centroid[:, 2] < ship.draft
    resolved = highest_resolved_frequency(float(mesh.area[wet].mean()), ship.gravity)
    assert database.frequencies[-1] == pytest.approx(min(resolved, 2.6 * np.sqrt(12.0)))


def test_panels_too_coarse_to_float_like_the_hull_are_refused_before_the_work() -> None:
    """At 20 m2 the LCG of the corvette that floats at its draft is 0.3 m from that of its hull."""
    begun: list[float] = []
    with pytest.raises(PanelsimError, match="too coarse") as refusal:
        HydroDatabase.compute(load_ship("corvette", 20.0), progress=lambda done, total: begun.append(done))
    assert "smaller ship.panel_area" in str(refusal.value) and "center of gravity x" in str(refusal.value)
    assert not begun
