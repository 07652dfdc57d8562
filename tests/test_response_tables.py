"""Motions in a sea by diffraction tables of other programs: how far they reach, and what is said of it."""

import numpy as np
import pytest

from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.diffraction import diffraction_load
from panelsim.hydro.tabulated_diffraction import highest_covered, largest_heading_step, require_covered
from panelsim.loads.supplementary import Supplementary
from panelsim.response.response import Response, response
from panelsim.seaway.direction.spreading import CosineSquared
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.ship.ship import Ship

WAVES = np.round(np.arange(0.2, 1.41, 0.05), 9)
SEA = Bretschneider(3.0, 9.0)


@pytest.fixture(scope="module")
def tables(halifax: Ship, halifax_database: HydroDatabase) -> HydroDatabase:
    """The coefficients of HALIFAX with tables every 10° all round in place of potentials."""
    headings = np.radians(np.arange(-170.0, 180.1, 10.0))
    omega, beta = (grid.ravel() for grid in np.meshgrid(WAVES, headings, indexing="ij"))
    load = diffraction_load(halifax_database, omega, beta, 0.0).reshape(len(WAVES), len(headings), 6)
    dims = ("wave_frequency", "wave_heading", "influenced_dof")
    held = halifax_database.dataset[["added_mass", "radiation_damping", "added_mass_infinite"]]
    dataset = held.assign(diffraction_real=(dims, load.real), diffraction_imag=(dims, load.imag))
    return HydroDatabase(dataset.assign_coords(wave_frequency=WAVES, wave_heading=headings))


def solved(ship: Ship, database: HydroDatabase, springs: Supplementary) -> Response:
    return response(
        ship, database, frequencies=[0.5], wave_headings=[np.pi], speeds=[0.0], supplementary=springs
    )


def test_tables_reach_to_where_their_steps_are_too_wide(tables: HydroDatabase) -> None:
    """4 = k L times the step of heading; stored headings need no step."""
    reach = np.sqrt(4.0 * tables.gravity / (np.radians(10.0) * tables.length))
    assert 1.3 < reach < 1.4
    assert largest_heading_step(tables, np.array([reach]))[0] == pytest.approx(np.radians(10.0), rel=1e-9)
    stored, between = np.radians([-40.0, 180.0, 50.0]), np.radians([50.0, 45.0])
    assert highest_covered(tables, stored) == 1.4
    for headings in (between, np.radians([-175.0]), np.radians([355.0]), None):
        assert highest_covered(tables, headings) == pytest.approx(reach, rel=1e-6)
    for omega, held in ((reach - 1e-3, True), (reach + 1e-3, False)):
        waves = np.array([omega]), between[1:]
        if held:
            require_covered(tables, *waves)
        else:
            with pytest.raises(PanelsimError, match="do not hold the heading"):
                require_covered(tables, *waves)


def test_steps_of_frequency_end_the_reach_too(tables: HydroDatabase) -> None:
    sparse = HydroDatabase(tables.dataset.isel(wave_frequency=[*range(17), 18, 20, 22, 24]))
    # From 1.0 on 0.1 rad/s apart, good to 2 g / (0.1 L) = 1.58: all is held; 0.15 apart it is 1.05.
    assert highest_covered(sparse, None) == pytest.approx(highest_covered(tables, None))
    sparser = HydroDatabase(tables.dataset.isel(wave_frequency=[*range(17), 19, 22]))
    assert highest_covered(sparser, None) == WAVES[16]


@pytest.mark.parametrize("spreading", [None, CosineSquared(np.pi / 2)])
def test_a_course_between_the_headings_of_a_table_is_answered(
    halifax: Ship,
    halifax_database: HydroDatabase,
    tables: HydroDatabase,
    springs: Supplementary,
    spreading: CosineSquared | None,
) -> None:
    """Nine seconds from 45°: the last waves of the table lie too far apart in heading, and are left out."""
    given = {"wave_headings": np.radians([45.0]), "spreading": spreading}
    found = solved(halifax, tables, springs).in_sea(SEA, **given)
    whole = solved(halifax, halifax_database, springs).in_sea(SEA, **given)
    held = SEA.energy_between(0.2, highest_covered(tables, None))
    # Below, a hundred-thousandth is left out of any sea.
    assert found.attrs["energy_share"] == pytest.approx(held, abs=2e-5)
    assert 0.9 < found.attrs["energy_share"] < 0.99
    left_out = 100.0 * (1.0 - found.attrs["energy_share"])
    assert found.attrs["notes"].startswith(f"{left_out:.2g} % of the energy of the sea is left out")
    assert "left out" not in whole.attrs["notes"]
    # Such waves hardly move her; between tables motions are within 3 % of their peak.
    np.testing.assert_allclose(found["rms"].values[0, 0], whole["rms"].values[0, 0], rtol=0.03)


def test_a_sea_within_the_tables_needs_no_word(
    halifax: Ship, tables: HydroDatabase, springs: Supplementary
) -> None:
    long = solved(halifax, tables, springs).in_sea(Bretschneider(3.0, 15.0), wave_headings=[np.pi])
    assert long.attrs["energy_share"] > 0.99 and "left out" not in long.attrs["notes"]
    with pytest.raises(PanelsimError, match="hold too little of the sea"):
        solved(halifax, tables, springs).in_sea(Bretschneider(1.0, 5.0), wave_headings=[0.8])
