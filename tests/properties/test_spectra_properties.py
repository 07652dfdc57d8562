"""What holds for every point spectrum: scaling, additivity, quantiles, energy that no speed changes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from panelsim.conventions import STANDARD_GRAVITY as G
from panelsim.seaway.spectra.bretschneider import Bretschneider
from panelsim.seaway.spectra.encounter import encounter_branches, encounter_density, encounter_energy
from panelsim.seaway.spectra.jonswap import Jonswap
from panelsim.seaway.spectra.ochi_hubble import OchiHubble
from panelsim.seaway.spectra.pierson_moskowitz import PiersonMoskowitz
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.spectra.table import TableSpectrum

reproducible = settings(derandomize=True, database=None, deadline=None, max_examples=40)
SHARE_ERROR = 1e-11  # what the quadrature of a share is good for

heights, periods = st.floats(0.1, 2.5), st.floats(4.0, 20.0)
shapes = st.floats(0.6, 8.0)
frequencies = st.floats(0.0, 6.0)
speeds, headings = st.floats(0.0, 25.0), st.floats(-np.pi, 2 * np.pi)


def table(rows: list[float]) -> TableSpectrum:
    return TableSpectrum(np.linspace(0.25, 1.8, len(rows)), np.array(rows))


spectra: st.SearchStrategy[PointSpectrum] = st.one_of(
    st.builds(Bretschneider, heights, periods),
    st.builds(Jonswap, heights, periods, st.floats(1.0, 10.0)),
    st.builds(PiersonMoskowitz, st.floats(3.0, 30.0)),
    st.builds(
        OchiHubble, st.tuples(heights, heights), st.tuples(periods, periods), st.tuples(shapes, shapes)
    ),
    st.builds(table, st.lists(st.floats(0.001, 0.01), min_size=2, max_size=12)),
)


@reproducible
@given(spectra, st.lists(frequencies, min_size=3, max_size=3))
def test_energy_is_additive_and_never_negative(spectrum: PointSpectrum, cuts: list[float]) -> None:
    low, middle, high = sorted(cuts)
    parts = spectrum.energy_between(low, middle), spectrum.energy_between(middle, high)
    assert min(parts) >= -SHARE_ERROR
    assert sum(parts) == pytest.approx(spectrum.energy_between(low, high), abs=SHARE_ERROR)
    assert spectrum.energy_between(0.0, high) + spectrum.energy_between(high, np.inf) == pytest.approx(
        1.0, abs=1e-11
    )
    assert spectrum.energy_between(0.0, high) == pytest.approx(
        spectrum.moment(0, high) / spectrum.moment(0) if high > 0 else 0.0, abs=SHARE_ERROR
    )


@reproducible
@given(spectra, st.floats(0.001, 0.999))
def test_a_quantile_holds_its_share(spectrum: PointSpectrum, share: float) -> None:
    frequency = spectrum.frequency_below(share)
    assert spectrum.energy_between(0.0, frequency) == pytest.approx(share, abs=SHARE_ERROR)


@reproducible
@given(spectra, st.floats(2.0, 8.0))
def test_moments_obey_schwarz(spectrum: PointSpectrum, upper: float) -> None:
    """m1² ≤ m0 m2 and m2² ≤ m0 m4, so that T_z ≤ T_1 ≤ T_e and 0 ≤ ε ≤ 1, with crests the most frequent."""
    assert spectrum.zero_crossing_period <= spectrum.mean_period <= spectrum.energy_period
    assert 0.0 <= spectrum.bandwidth(upper) <= 1.0
    m0, m2 = spectrum.moment(0, upper), spectrum.moment(2, upper)
    assert spectrum.crest_period(upper) <= 2 * np.pi * np.sqrt(m0 / m2)
    epsilon = np.sqrt(1 - m2**2 / (m0 * spectrum.moment(4, upper)))
    assert spectrum.bandwidth(upper) == pytest.approx(epsilon, rel=1e-9)


@reproducible
@given(heights, periods, st.floats(1.0, 10.0), shapes, st.floats(0.5, 0.95), st.floats(1.0, 2.0))
def test_height_and_period_scale_the_spectrum(
    height: float, period: float, gamma: float, shape: float, lower: float, longer: float
) -> None:
    """S goes with H_s² and, at the same ω/ω_p, with T_p; the longer sea is the less steep by T_p²."""
    ratio = np.array([0.6, 0.9, 1.0, 1.1, 2.5])
    for make in (
        Bretschneider,
        lambda h, t: Jonswap(h, t, gamma),
        lambda h, t: OchiHubble((h,), (t,), (shape,)),
    ):
        sea, other = make(height, period), make(lower * height, longer * period)
        omega = ratio * 2 * np.pi / period
        np.testing.assert_allclose(
            other.density(omega / longer), lower**2 * longer * sea.density(omega), rtol=1e-10
        )
        assert other.nominal_steepness == pytest.approx(lower / longer**2 * sea.nominal_steepness)
        assert other.mean_period == pytest.approx(longer * sea.mean_period)


@reproducible
@given(spectra, speeds, headings)
def test_speed_and_heading_do_not_change_the_energy(
    spectrum: PointSpectrum, speed: float, heading: float
) -> None:
    """The bands of |ω_e| hold m0 in all, none is negative, and port and starboard are alike."""
    edges = np.concatenate([np.linspace(0.0, 4.0, 17), [20.0, np.inf]])
    energy = encounter_energy(spectrum, edges, speed, heading)
    m0 = spectrum.moment(0)
    assert energy.sum() == pytest.approx(m0, rel=1e-10)
    assert energy.min() >= -2 * SHARE_ERROR * m0
    mirrored = encounter_energy(spectrum, edges, speed, -heading)
    np.testing.assert_allclose(mirrored, energy, atol=1e-9 * m0)


@reproducible
@given(st.floats(0.0, 5.0), speeds, headings)
def test_a_branch_is_met_at_the_frequency_asked_for(met: float, speed: float, heading: float) -> None:
    omega = encounter_branches(met, speed, heading)
    tau = speed * np.cos(heading) / G
    first, others = omega[0], omega[1:]
    # Abeam τ is a rounding error and 1/τ some 1e16 rad/s: there the rounding of τω² drowns |ω_e|.
    waves = omega[omega < 1e6]
    np.testing.assert_allclose(np.abs(waves - tau * waves**2), met, atol=1e-9)
    if tau <= 0:
        assert np.isfinite(first) and np.isnan(others).all()


@reproducible
@given(spectra, speeds, headings, st.floats(0.01, 4.0))
def test_encounter_density_is_the_slope_of_the_energy(
    spectrum: PointSpectrum, speed: float, heading: float, met: float
) -> None:
    """At some distance from the singular frequency, where the density changes little over a band of 2e-4."""
    tau = speed * np.cos(heading) / G
    if abs(1 - 4 * tau * met) < 0.05:
        return
    energy = encounter_energy(spectrum, [met - 1e-4, met + 1e-4], speed, heading)[0]
    density = float(encounter_density(spectrum, met, speed, heading))
    # A corner or an end of a table inside the band changes the mean by half of what it changes the density.
    corner = 0.6 * density if isinstance(spectrum, TableSpectrum) else 0.0
    assert energy / 2e-4 == pytest.approx(density, rel=1e-3, abs=1e-3 * spectrum.moment(0) + corner)
