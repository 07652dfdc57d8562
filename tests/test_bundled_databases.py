"""The coefficients that travel with the bundled ships belong to them and are fit for use."""

import numpy as np
import pytest

from panelsim.hull.form import bundled_hull_names, hull_folder
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.memory import memory_functions
from panelsim.hydro.store import STORED_NAME
from panelsim.ship.bundled import load_ship

NAMES = bundled_hull_names()


def test_all_reference_ships_are_bundled() -> None:
    assert set(NAMES) == {
        *("frigate", "corvette", "supply_ship", "halifax", "mine_hunter", "s175"),
        *("wigley_i", "wigley_ii", "wigley_iii", "wigley_iv", "box", "sphere", "cylinder"),
    }


@pytest.mark.parametrize("name", NAMES)
def test_stored_coefficients_belong_to_the_ship(name: str) -> None:
    """On two panel sizes of the ship, since one database serves a mesh study."""
    database = HydroDatabase.load(hull_folder(name) / STORED_NAME)
    ship = load_ship(name)
    database.require_for(ship)
    database.require_for(ship.at_panel_area(ship.mesh.area.mean() / 2))


@pytest.mark.parametrize("name", NAMES)
def test_stored_coefficients_can_be_run(name: str) -> None:
    """The memory reproduces them (3 %, else it raises), and A∞ of both kinds agrees within 1.5 %."""
    memory = memory_functions(HydroDatabase.load(hull_folder(name) / STORED_NAME))
    worst = np.abs(memory.infinite_difference).max()
    print(f"{name}: A∞ of the panels against Ogilvie {100 * worst:.2f} %")
    assert worst < 0.015  # 0.7 to 1.1 % is found


def test_geosims_have_scaled_coefficients() -> None:
    """Froude: A33 as length³, A55 as length⁵, at frequencies that go with the root of 1/length."""
    frigate, corvette = (HydroDatabase.load(hull_folder(n) / STORED_NAME) for n in ("frigate", "corvette"))
    scale = 70.0 / 120.0
    np.testing.assert_allclose(corvette.frequencies, frigate.frequencies / np.sqrt(scale), rtol=2e-3)
    for dof, power in ((2, 3), (4, 5), (3, 5)):
        ratio = corvette.added_mass_infinite[dof, dof] / frigate.added_mass_infinite[dof, dof]
        # Table 3 rounds the corvette's beam and draft; its panels follow in proportion.
        assert ratio == pytest.approx(scale**power, rel=5e-3)
