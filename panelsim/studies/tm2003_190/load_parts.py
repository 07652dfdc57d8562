"""Which nonlinear load makes which motion: the pressure load of a stored run, taken apart.

The load less its linear part is a sum of what the waves do to the ship at rest, of what her motions do in
calm water, and of products of both. The linear ship answers each by itself, and the answers add up to the
difference of the nonlinear run from the linear one, but for what the motions change in return.
"""

from dataclasses import dataclass

import numpy as np

from panelsim.case import Case
from panelsim.conventions import Dof, FloatArray
from panelsim.loads.froude_krylov import froude_krylov_transfer
from panelsim.loads.load import Instant
from panelsim.loads.wetted_surface import WettedSurface
from panelsim.motion.equations import ramp_factor
from panelsim.response.linear_ship import LinearShip
from panelsim.studies.run_store import RunStore, StoredRun

PARTS = (
    "waves alone, ship at rest",
    "motions alone, in calm water",
    "waves and heave, pitch",
    "waves and surge, sway, yaw",
    "waves and roll, and the rest",
)
_STILL = 1e-4  # rad/s: for the mean, at which speed terms divide by the frequency


@dataclass(frozen=True)
class LoadParts:
    """The answers of six motions to `PARTS`, beside the difference of the models.

    `rms` (5, 6) is the RMS of each answer over that of the difference. `shares` (5, 6) is its covariance with
    the difference over the variance of that: below 0 and above 1 where parts act against each other. `missed`
    (6,) is the RMS of what all answers together do not explain, over that of the difference.
    """

    rms: FloatArray
    shares: FloatArray
    missed: FloatArray

    @property
    def missed_alone(self) -> FloatArray:
        """RMS (5, 6) of what each answer by itself does not explain, over that of the difference."""
        return np.asarray(np.sqrt(np.maximum(1.0 - 2.0 * self.shares + self.rms**2, 0.0)))


def load_parts(nonlinear: Case, linear: Case, store: RunStore) -> LoadParts:
    """Take the nonlinear run of a case apart, beside the linear one in the same waves; both are stored.

    Raises PanelsimError where one is not.
    """
    run, beside = store.load(nonlinear), store.load(linear)
    after = run.after_ramp
    answers = np.array(
        [answer_to(nonlinear, run.time, part)[after] for part in pressure_parts(nonlinear, run)]
    )
    difference = (run.displacement - beside.displacement)[after]
    difference = difference - difference.mean(axis=0)
    variance = np.mean(difference**2, axis=0)
    return LoadParts(
        answers.std(axis=1) / np.sqrt(variance),
        np.mean(answers * difference, axis=1) / variance,
        (answers.sum(axis=0) - difference).std(axis=0) / np.sqrt(variance),
    )


def pressure_parts(case: Case, run: StoredRun) -> list[FloatArray]:
    """Nonlinear pressure loads (T, 6) of each of `PARTS` [N, N m]."""
    waves, speed, ship = case.seaway.components, case.speed, case.ship
    surface = WettedSurface(
        ship, [waves], [speed], rule=case.file.run.pressure_rule, stretching=case.file.seaway.stretching
    )
    factor = np.array([ramp_factor(float(time), case.file.run.ramp) for time in run.time])

    def load(moving: tuple[Dof, ...], *, in_waves: bool) -> FloatArray:
        poses = np.zeros_like(run.displacement)
        poses[:, moving] = run.displacement[:, moving]
        wave_factor = factor if in_waves else np.zeros_like(factor)
        still = np.zeros((1, 6))
        return np.array(
            [
                surface.evaluate(Instant(float(time), float(share), pose[None], still))[0]
                for time, share, pose in zip(run.time, wave_factor, poses, strict=True)
            ]
        )

    vertical, horizontal = (Dof.HEAVE, Dof.PITCH), (Dof.SURGE, Dof.SWAY, Dof.YAW)
    rest = surface.evaluate(Instant(0.0, 0.0, np.zeros((1, 6)), np.zeros((1, 6))))[0]
    at_rest, calm = load((), in_waves=True), load(tuple(Dof), in_waves=False)
    angle = np.outer(run.time, waves.encounter_frequency(speed, ship.gravity)) + waves.phase
    froude_krylov = (np.exp(1j * angle) * waves.amplitude @ froude_krylov_transfer(ship, waves)).real
    linear_waves = froude_krylov * factor[:, None]
    restoring = run.displacement @ ship.hydrostatics.stiffness.T
    parts = [
        at_rest - rest - linear_waves,
        calm - rest + restoring,
        load(vertical, in_waves=True) - at_rest - load(vertical, in_waves=False) + rest,
        load(horizontal, in_waves=True) - at_rest,
    ]
    whole = load(tuple(Dof), in_waves=True) - rest - linear_waves + restoring
    return [*parts, whole - np.sum(parts, axis=0)]


def answer_to(case: Case, time: FloatArray, load: FloatArray) -> FloatArray:
    """Motions (T, 6) of the linear ship, at rest before, under a load (T, 6)."""
    count = 2 * len(time)  # what she does at the end of the record must not come round to its beginning
    frequency = 2.0 * np.pi * np.fft.rfftfreq(count, time[1] - time[0])
    frequency[0] = _STILL
    ship = LinearShip(case.ship, case.database(), case.supplementary)
    impedance = ship.impedance(frequency, case.speed, 0.0)
    spectrum = np.fft.rfft(load, count, axis=0)
    return np.fft.irfft(np.linalg.solve(impedance, spectrum[:, :, None])[:, :, 0], count, axis=0)[: len(time)]
