"""Statistics of a run from the end of its ramp."""

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from panelsim.conventions import DOF_NAMES, Dof, FloatArray, IntArray
from panelsim.motion.history import History
from panelsim.motion.point_motions import point_signals
from panelsim.ship.points import POINT_UNITS

STILL = 1e-9  # m or rad: rounding, on any ship or model


@dataclass(frozen=True)
class SignalStatistics:
    """Mean, RMS about the mean, extremes [SI] and mean up-crossing period [s]; None: not defined."""

    mean: float | None
    rms: float | None
    max: float | None
    min: float | None
    zero_crossing_period: float | None


NOTHING = SignalStatistics(None, None, None, None, None)


@dataclass(frozen=True)
class Statistics:
    """Statistics of the six motions and of the wave at the moving origin, in m, rad and s.

    `points` has those of what each named point of the ship does, by the names of `POINT_UNITS`.
    `duration` is the time that they cover: from the ramp to the end of the run. `realtime_factor` is
    simulated seconds per CPU second of the time loop. `note` says why values are missing, if they are.
    """

    motions: dict[str, SignalStatistics]
    wave_elevation: SignalStatistics
    duration: float
    ramp: float
    simulated_seconds: float
    cpu_seconds: float | None
    jit_seconds: float | None
    outcome: str
    outcome_detail: str
    note: str
    points: dict[str, dict[str, SignalStatistics]]

    @property
    def significant_wave_height_realised(self) -> float | None:
        """Four times the RMS of the wave at the moving origin [m]."""
        return None if self.wave_elevation.rms is None else 4.0 * self.wave_elevation.rms

    @property
    def realtime_factor(self) -> float | None:
        return self.simulated_seconds / self.cpu_seconds if self.cpu_seconds else None

    def to_json(self) -> str:
        """JSON text with the unit in every key, angles in degrees; what is not defined is null."""
        tables: dict[str, Any] = {name: _entry(self.motions[name], name) for name in DOF_NAMES}
        tables["wave_elevation"] = _entry(self.wave_elevation, "wave_elevation")
        tables["significant_wave_height_realised_m"] = self.significant_wave_height_realised
        tables["duration_s"] = self.duration
        if self.points:
            tables["points"] = {
                point: {name: _entry(values, name) for name, values in signals.items()}
                for point, signals in self.points.items()
            }
        tables["ramp_s"] = self.ramp
        tables["simulated_seconds"] = self.simulated_seconds
        tables["cpu_seconds"] = self.cpu_seconds
        tables["jit_seconds"] = self.jit_seconds
        tables["realtime_factor"] = self.realtime_factor
        tables["outcome"] = self.outcome
        tables["outcome_detail"] = self.outcome_detail
        tables["note"] = self.note
        return json.dumps(tables, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def display_unit(signal: str) -> tuple[str, float]:
    """Unit in which people read a motion, elevation or signal of a point, and the factor to it from SI."""
    if signal in POINT_UNITS:
        return POINT_UNITS[signal], 1.0
    if signal in DOF_NAMES and Dof[signal.upper()] >= Dof.ROLL:
        return "deg", 180.0 / np.pi
    return "m", 1.0


def statistics(history: History) -> Statistics:
    """Statistics of a history from t = ramp on; all None, with a note, if the run ended before that.

    Rows from the first one that is not finite, as a diverged run may leave, are not counted.
    """
    signals = np.column_stack([history.displacement, history.wave_elevation])
    # half a step of room: the ramp need not be a whole number of binary steps
    after_ramp = history.time >= history.attrs["ramp"] - 0.5 * history.attrs["time_step"]
    rows = np.flatnonzero(history.finite & after_ramp)
    time, signals = history.time[rows], signals[rows]
    each = _of_columns(time, signals)
    return Statistics(
        motions=dict(zip(DOF_NAMES, each[:6], strict=True)),
        wave_elevation=each[6],
        duration=float(time[-1] - time[0]) if len(rows) else 0.0,
        ramp=float(history.attrs["ramp"]),
        simulated_seconds=float(history.attrs["simulated_seconds"]),
        cpu_seconds=_none_if_nan(history.attrs["cpu_seconds"]),
        jit_seconds=_none_if_nan(history.attrs["jit_seconds"]),
        outcome=history.outcome,
        outcome_detail=str(history.attrs["outcome_detail"]),
        note=_note(history, len(rows)),
        points={
            name: _of_point(time, point_signals(motions), rows) for name, motions in history.points.items()
        },
    )


def zero_crossing_period(time: FloatArray, signal: FloatArray) -> float | None:
    """Mean time between up-crossings of the mean [s], or None with fewer than two of them.

    `time` and `signal` (T,); crossings are interpolated linearly.
    """
    about_mean = signal - signal.mean()
    # The round-off of a constant is no motion, nor is that of a motion that symmetry forbids.
    if about_mean.std() <= max(1e-12 * np.abs(signal).max(), STILL):
        return None
    before = np.flatnonzero((about_mean[:-1] < 0.0) & (about_mean[1:] >= 0.0))
    if len(before) < 2:
        return None
    low, high = about_mean[before], about_mean[before + 1]
    crossing = time[before] - low / (high - low) * (time[before + 1] - time[before])
    return float((crossing[-1] - crossing[0]) / (len(crossing) - 1))


def _of_columns(time: FloatArray, columns: FloatArray) -> list[SignalStatistics]:
    """Statistics of the columns (T, N), one each; NOTHING for less than two rows."""
    if len(time) < 2:
        return [NOTHING] * columns.shape[1]
    return [_signal_statistics(time, column) for column in columns.T]


def _of_point(
    time: FloatArray, signals: dict[str, FloatArray], rows: IntArray
) -> dict[str, SignalStatistics]:
    columns = np.column_stack([values[rows] for values in signals.values()])
    return dict(zip(signals, _of_columns(time, columns), strict=True))


def _signal_statistics(time: FloatArray, signal: FloatArray) -> SignalStatistics:
    return SignalStatistics(
        mean=float(signal.mean()),
        rms=float(signal.std()),
        max=float(signal.max()),
        min=float(signal.min()),
        zero_crossing_period=zero_crossing_period(time, signal),
    )


def _entry(values: SignalStatistics, signal: str) -> dict[str, float | None]:
    unit, factor = display_unit(signal)
    amounts = {"mean": values.mean, "rms": values.rms, "max": values.max, "min": values.min}
    entry = {f"{key}_{unit}": None if v is None else v * factor for key, v in amounts.items()}
    return entry | {"zero_crossing_period_s": values.zero_crossing_period}


def _none_if_nan(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _note(history: History, row_count: int) -> str:
    notes = []
    if not history.finite.all():
        notes.append(f"The motions are no numbers from t = {history.time[history.finite.argmin()]:g} s on.")
    if row_count < 2:
        notes.append(f"The run ended before its ramp of {history.attrs['ramp']:g} s did: no statistics.")
    return " ".join(notes)
