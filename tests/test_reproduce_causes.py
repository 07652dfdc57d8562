"""What makes the difference of the models: loads taken apart, frequencies, a ship that is held."""

from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from panelsim.case import Case
from panelsim.conventions import Dof, FloatArray
from panelsim.seaway.components import WaveComponents
from panelsim.studies.run_store import StoredRun
from panelsim.studies.tm2003_190 import load_parts as load_parts_module
from panelsim.studies.tm2003_190 import mesh
from panelsim.studies.tm2003_190.common import Scope, base_case, in_sea, study_sea
from panelsim.studies.tm2003_190.held_runs import held, held_in_words, held_markdown, what_stays
from panelsim.studies.tm2003_190.load_parts import LoadParts, answer_to, pressure_parts
from panelsim.studies.tm2003_190.model_causes import (
    Frequencies,
    Pair,
    cause_in_words,
    frequencies_markdown,
    frequencies_of,
    loads_in_words,
    parts_markdown,
)
from panelsim.studies.tm2003_190.wave_frequencies import LEAST_SHARE, at_wave_frequencies

VERTICAL, HORIZONTAL = [Dof.HEAVE, Dof.PITCH], [Dof.SURGE, Dof.SWAY, Dof.YAW]
WAVES, MOTIONS, WITH_VERTICAL, WITH_HORIZONTAL, REST = range(5)


class MadeUpRuns:
    """Motions by model, whether or not heave and pitch are held; all runs went to their end."""

    def __init__(self, motions: Mapping[tuple[str, bool], FloatArray], step: float = 0.2) -> None:
        self._motions, self._step = motions, step

    def __contains__(self, case: Case) -> bool:
        return True

    def failure(self, case: Case) -> str | None:
        return None

    def rms(self, case: Case) -> tuple[FloatArray, str | None]:
        run = self.load(case)
        return run.rms, run.early_end

    def load(self, case: Case) -> StoredRun:
        motions = self._motions[case.file.run.model, "heave" in case.supplementary.stiffness]
        return stored(motions, self._step)


def stored(motions: FloatArray, step: float = 0.2, ramp: float = 0.0) -> StoredRun:
    time = step * np.arange(len(motions))
    attrs = {"outcome": "finished", "outcome_detail": "", "ramp": ramp, "time_step": step}
    return StoredRun(time, motions, np.zeros(len(time)), attrs)


@pytest.fixture(scope="module")
def bow() -> Case:
    """A nonlinear case in a bow quartering sea, on coarse panels, without a ramp."""
    coarse = base_case().changed({"ship.panel_area": 20.0, "run.ramp": 0.0})
    return in_sea(coarse, study_sea(150.0, 6.0, 0.049), 0)


def parts(case: Case, modes: list[Dof], size: float = 1.0, height: float = 1.0) -> FloatArray:
    """The parts (5, T, 6) of a ship that moves in some modes, by a metre or 0.02 rad times `size`."""
    time = 3.0 * np.arange(5)
    motions = np.zeros((5, 6))
    amplitude = size * np.array([1.0, 1.0, 1.0, 0.02, 0.02, 0.02])
    motions[:, modes] = (amplitude * np.cos(0.4 * time[:, None] + np.arange(6)))[:, modes]
    if height != 1.0:
        case = case.changed({"seaway.significant_wave_height": 6.0 * height})
    return np.array(pressure_parts(case, stored(motions, 3.0)))


def largest(part: FloatArray) -> FloatArray:
    """Largest force [N] and moment [N m] in waves' modes, the moment over a lever of 40 m."""
    return np.abs(part / np.array([1.0, 1.0, 1.0, 40.0, 40.0, 40.0])).max()


def test_a_ship_at_rest_has_a_load_of_the_waves_alone_of_second_order(bow: Case) -> None:
    found = parts(bow, [])
    assert largest(found[WAVES]) > 1e5
    # Rounding of a weight of 47 MN.
    assert largest(found[1:]) < 1e-4
    low, lower = (parts(bow, [], height=height)[WAVES] for height in (0.02, 0.01))
    # A linear part would halve and leave a ratio of 2; what is of third order is some per cent in low waves.
    assert largest(low) / largest(lower) == pytest.approx(4.0, rel=0.15)


def test_motions_in_calm_water_have_a_load_of_second_order(bow: Case) -> None:
    still = bow.changed({"seaway.significant_wave_height": 1e-6})
    found = parts(still, VERTICAL)
    assert largest(found[MOTIONS]) > 1e5
    assert (
        largest(found[[WAVES, WITH_VERTICAL, WITH_HORIZONTAL, REST]]) < 10.0
    )  # of the waves of a micrometre
    small, smaller = (parts(still, VERTICAL, size=size)[MOTIONS] for size in (0.02, 0.01))
    # The mesh is finite: its waterline area is that of its panels, a little off that of the restoring.
    assert largest(small) / largest(smaller) == pytest.approx(4.0, rel=0.5)
    assert largest(small) < 0.05 * largest(found[MOTIONS])


def test_each_product_is_of_its_own_motions(bow: Case) -> None:
    vertical, horizontal = parts(bow, VERTICAL), parts(bow, HORIZONTAL)
    assert largest(vertical[WITH_VERTICAL]) > 1e5
    assert largest(vertical[[WITH_HORIZONTAL, REST]]) < 1e-3  # rounding
    assert largest(horizontal[WITH_HORIZONTAL]) > 1e5
    assert largest(horizontal[[MOTIONS, WITH_VERTICAL, REST]]) < 1e-3
    np.testing.assert_allclose(vertical[WAVES], parts(bow, [])[WAVES], atol=1e-3)
    roll = parts(bow, [Dof.ROLL])
    assert largest(roll[REST]) > 5e3  # 0.02 rad are little
    assert largest(roll[[WITH_VERTICAL, WITH_HORIZONTAL]]) < 1e-3


def test_all_parts_together_are_the_load_that_is_not_linear(bow: Case) -> None:
    """Whatever moves: in the sum only the whole load, the linear one and the ship's rest stay."""
    everything = parts(bow, list(Dof))
    for dropped in range(5):
        assert largest(everything[dropped]) > 1e4
    # Low waves and small motions: all of it is of second order.
    low, lower = (parts(bow, list(Dof), size, size).sum(axis=0) for size in (0.02, 0.01))
    assert largest(lower) / largest(low) < 0.4


def test_a_slow_force_is_answered_by_the_stiffness(bow: Case) -> None:
    """A force that comes and goes in ten minutes is answered as in statics."""
    time = 1.0 * np.arange(1200)
    force = np.outer(np.sin(np.pi * time / 1200.0) ** 2, [1e5, 2e5, 1e6, 0.0, 5e7, 3e7])
    found = answer_to(bow.changed({"run.speed_knots": 0.0}), time, force)[600]
    stiffness = bow.ship.hydrostatics.stiffness + bow.supplementary.stiffness_matrix
    # Damping and added mass at 20 minutes change it by less than some per cent.
    expected = np.linalg.solve(stiffness, force[600])
    np.testing.assert_allclose(found[[2, 4]], expected[[2, 4]], rtol=0.05)
    assert found[0] == pytest.approx(expected[0], rel=0.1)


def pair(case: Case) -> Pair:
    return Pair("a sea", case.changed({"run.model": "linear"}), case)


def test_what_is_at_others_than_the_frequencies_of_the_waves(bow: Case) -> None:
    """Linear: at the waves, and a hundredth elsewhere; nonlinear: a tenth more, and as much elsewhere."""
    waves = bow.seaway.components
    met = waves.encounter_frequency(bow.speed, 9.80665)[np.argmax(waves.amplitude)]
    time = 0.2 * np.arange(10000)
    at_waves, slow = np.cos(met * time)[:, None], np.cos(0.1 * time)[:, None]
    one = np.ones(6)
    store = MadeUpRuns(
        {
            ("linear", False): (at_waves + 0.1 * slow) * one,
            ("nonlinear", False): (1.1 * at_waves + 1.1 * slow) * one,
        }
    )
    found = frequencies_of([pair(bow)], store)  # type: ignore[arg-type]
    # 2000 s are 31 turns of the slow motion: what leaks from it is of the order of a hundredth.
    np.testing.assert_allclose(found.elsewhere, 0.5, atol=0.01)
    np.testing.assert_allclose(found.control, 0.01 / 1.01, atol=1e-3)
    np.testing.assert_allclose(found.change, 0.1, atol=0.01)
    assert "| a sea | 50 (1), +10 |" in frequencies_markdown(found)


@pytest.mark.parametrize(("share", "counts"), [(0.00105, True), (0.00095, False)])
def test_waves_of_less_than_a_thousandth_of_the_energy_do_not_count(share: float, counts: bool) -> None:
    amplitude = np.sqrt([1.0, share])
    waves = WaveComponents(amplitude, np.array([0.7, 1.2]), np.full(2, np.pi / 2), np.zeros(2))
    time = 0.2 * np.arange(3000)
    run = stored(np.cos(1.2 * time)[:, None] * np.ones(6))
    found = at_wave_frequencies(run, waves, 5.0, 9.80665)
    expected = np.sqrt(0.5) if counts else 0.0
    np.testing.assert_allclose(found, expected, atol=0.02)  # 600 s are no whole number of turns


def taken_apart(rms: list[float], shares: list[float]) -> LoadParts:
    """The same of all motions."""
    return LoadParts(np.tile(rms, (6, 1)).T, np.tile(shares, (6, 1)).T, np.full(6, 0.1))


def test_a_load_makes_a_difference_only_if_its_own_answer_is_like_it() -> None:
    alone = taken_apart([0.1, 0.1, 0.9, 0.2, 0.1], [0.0, 0.0, 0.9, 0.1, 0.0])
    # 1 - 2 0.9 + 0.81
    assert alone.missed_alone[2, 0] == pytest.approx(0.1)
    told = loads_in_words("a sea", alone)
    assert told == (
        "at a sea the load of waves and heave, pitch alone makes most of the difference of surge, sway, roll"
        " and yaw"
    )
    # The share is above 1, but the answer is larger than the difference, and another takes it away again.
    cancelling = taken_apart([0.8, 0.1, 1.4, 0.2, 0.1], [-0.2, 0.0, 1.07, 0.1, 0.03])
    told = loads_in_words("a sea", cancelling)
    assert "alone makes" not in told
    assert "no single load makes that of surge, sway, roll and yaw: parts cancel" in told
    assert "up to 1.4 times the difference" in told
    # What it misses by itself is 0.6: more than half.
    together = loads_in_words("a sea", taken_apart([1.1, 0, 0, 0, 0], [0.9, 0, 0, 0, 0]))
    assert "alone makes" not in together and "several act together" in together
    mixed = LoadParts(alone.rms.copy(), alone.shares.copy(), alone.missed)
    mixed.rms[:, Dof.YAW], mixed.shares[:, Dof.YAW] = cancelling.rms[:, 0], cancelling.shares[:, 0]
    told = loads_in_words("a sea", mixed)
    assert "difference of surge, sway and roll, no single load makes that of yaw" in told
    assert "| a sea | waves and heave, pitch | 90, +90 | 90, +90 |" in parts_markdown({"a sea": alone})


def test_the_words_have_the_linear_model_as_control() -> None:
    elsewhere, control = np.full((1, 6), 0.8), np.full((1, 6), 0.07)
    told = cause_in_words(Frequencies(("a sea",), elsewhere, control, np.full((1, 6), -0.02)), {})
    assert "80 % of the variance on average (7 % in the linear model) is not at the waves'" in told
    assert "differ by 2 % (median)" in told
    assert cause_in_words(Frequencies((), *3 * [np.empty((0, 6))]), {}) == ""


def test_answers_beside_the_difference_of_the_models(bow: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    """Answers 3 a, b and -a, a and b of other frequencies; the models differ by 2 a + 2 b."""
    time = 2.0 * np.pi * np.arange(1000) / 1000.0
    a, b = (np.sqrt(2.0) * np.cos(turns * time)[:, None] * np.ones(6) for turns in (3, 7))
    store = MadeUpRuns({("linear", False): a, ("nonlinear", False): 3.0 * a + 2.0 * b})
    answers = [3.0 * a, b, -a, 0.0 * a, 0.0 * a]
    monkeypatch.setattr(load_parts_module, "pressure_parts", lambda case, run: list(range(5)))
    monkeypatch.setattr(load_parts_module, "answer_to", lambda case, time, part: answers[part])
    of = pair(bow)
    found = load_parts_module.load_parts(of.nonlinear, of.linear, store)  # type: ignore[arg-type]
    # The difference has the variance 2² + 2² = 8; all answers miss b of it. Rounding.
    for values, expected in (
        (found.rms, np.array([3.0, 1.0, 1.0, 0.0, 0.0]) / np.sqrt(8.0)),
        (found.shares, np.array([6.0, 2.0, -2.0, 0.0, 0.0]) / 8.0),
    ):
        np.testing.assert_allclose(values, np.repeat(expected[:, None], 6, axis=1), atol=1e-12)
    np.testing.assert_allclose(found.missed, 1.0 / np.sqrt(8.0), rtol=1e-12)


def test_what_stays_with_heave_and_pitch_held(bow: Case) -> None:
    """Held, the models differ by half of what they differ by free: a quarter of the variance."""
    time = 0.2 * np.arange(1000)
    linear, apart = np.sin(time)[:, None] * np.ones(6), np.cos(0.1 * time)[:, None] * np.ones(6)
    store = MadeUpRuns(
        {
            ("linear", False): linear,
            ("nonlinear", False): linear + apart,
            ("linear", True): 0.3 * linear,
            ("nonlinear", True): 0.3 * linear + 0.5 * apart,
        }
    )
    one = held(pair(bow))
    assert one.held.linear.file.run.time_step == 0.5 * bow.file.run.time_step  # the springs turn in 0.9 s
    assert one.held.nonlinear.supplementary.stiffness["yaw"] == bow.supplementary.stiffness["yaw"]
    assert one.held.linear.file.run.model == "linear"
    stays = what_stays([one, one], store)  # type: ignore[arg-type]
    np.testing.assert_allclose(stays, 0.25, rtol=1e-12)  # rounding
    assert held_in_words(stays).endswith("surge 25 %, sway 25 %, roll 25 %, yaw 25 %")
    assert "| a sea | 25 | 25 | 25 | 25 |" in held_markdown({"a sea": stays})
    assert held_in_words(np.full(6, np.nan)) == ""
    assert "| a sea | – |" in held_markdown({"a sea": np.full(6, np.nan)})


class RollOfMeshes:
    """Runs that roll with a wave and at 3 rad/s, where no wave is met: how much, by wetting and panel area.

    In bow quartering seas all are alike, and so are the other motions in all seas.
    """

    AMPLITUDES: ClassVar = {
        ("vertex+centre", 1.0): (1.0, 1.0),
        ("vertex+centre", 2.5): (1.1, 1.2),
        ("vertex+centre", 5.0): (1.2, 1.5),
        ("panel", 1.0): (1.0, 1.0),
        ("panel", 2.5): (1.0, 1.5),
        ("panel", 5.0): (1.0, 2.0),
    }

    def __contains__(self, case: Case) -> bool:
        return True

    def failure(self, case: Case) -> str | None:
        return None

    def rms(self, case: Case) -> tuple[FloatArray, str | None]:
        return self.load(case).rms, None

    def load(self, case: Case) -> StoredRun:
        waves = case.seaway.components
        energetic = waves.amplitude**2 > 2.0 * LEAST_SHARE * waves.variance
        # The fastest of them, which no other comes near.
        met = np.abs(waves.encounter_frequency(case.speed, case.file.ship.gravity)[energetic]).max()
        time = 0.2 * np.arange(1501)
        motions = np.repeat(np.cos(met * time)[:, None], 6, axis=1)
        key = case.file.run.pressure_rule, case.file.ship.panel_area or 0.0
        at_wave, elsewhere = self.AMPLITUDES[key] if case.file.seaway.wave_heading_deg == 30.0 else (1.0, 1.0)
        motions[:, Dof.ROLL] = at_wave * np.cos(met * time) + elsewhere * np.cos(3.0 * time)
        return stored(motions)


def test_a_mesh_that_differs_says_at_which_frequencies_and_what_cutting_brings(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mesh, "rms_over_height", lambda study, heading, path: path)
    study = mesh.Mesh(base_case(), Scope((2.0,), 1, 1, 300.0))
    medium, coarse, whole_medium, whole_coarse = study.section(
        RollOfMeshes(),  # type: ignore[arg-type]
        tmp_path,
    ).statements
    # The whole: √((1.2² + 1.5²)/2) - 1 = 36 %. Elsewhere: 1.5²/(1.2² + 1.5²) = 61 %.
    assert "+36 % in roll" in coarse.figures and "+15 % in roll" in medium.figures
    assert "roll is +20 % off there" in coarse.remark and "61 % of its variance" in coarse.remark
    assert "roll is +10 % off there" in medium.remark and "54 % of its variance" in medium.remark
    # √((1 + 2²)/2) - 1 = 58 % of whole panels, beside what the same mesh has cut.
    assert "+58 % in roll" in whole_coarse.figures
    assert "cut at the water the same mesh is at most +36 % in roll" in whole_coarse.remark
    assert "cut at the water the same mesh is at most +15 % in roll" in whole_medium.remark
