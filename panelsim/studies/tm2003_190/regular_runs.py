"""Runs in regular head seas, their harmonics, and the frequency domain beside them."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from panelsim.case import Case
from panelsim.conventions import KNOT, ComplexArray, Dof, FloatArray
from panelsim.response.response import response
from panelsim.results.harmonics import Harmonics, harmonics
from panelsim.results.rms_study import MINOR
from panelsim.seaway.dispersion import encounter_frequency
from panelsim.studies.run_store import RunStore, StoredRun

MODES = (Dof.HEAVE, Dof.PITCH)
MODE_NAMES = ("heave", "pitch")
TIME_STEP, RAMP, TRANSIENT, MEASURED = 0.1, 60.0, 60.0, 120.0  # s


@dataclass(frozen=True, eq=False)
class Measured:
    """Heave over the wave amplitude a and pitch over k a, last axis (2,), by (Froude number, λ/L, H/λ).

    `transfer` (F, R, H, 2) is the complex first harmonic, 0 the phase of a crest at the centre of gravity;
    `mean` and `second` the mean and the amplitude of the second harmonic over the same; `unsettled` how far
    the last two windows differ, over the first harmonic. NaN where a run failed, which `failures` tell.
    """

    transfer: ComplexArray
    mean: FloatArray
    second: FloatArray
    unsettled: FloatArray
    failures: tuple[str, ...]


@dataclass(frozen=True)
class RegularRuns:
    """Runs in head seas of all Froude numbers, λ/L and H/λ; `changes` are keys of the case beside these."""

    base: Case
    froude: tuple[float, ...]
    length_ratio: tuple[float, ...]
    steepness: tuple[float, ...]
    changes: Mapping[str, Any]

    @cached_property
    def by_index(self) -> dict[tuple[int, int, int], Case]:
        """The cases by the indices of Froude number, λ/L and H/λ."""
        shape = len(self.froude), len(self.length_ratio), len(self.steepness)
        return {(f, r, h): self._case(f, r, h) for f, r, h in np.ndindex(shape)}

    def _case(self, f: int, r: int, h: int) -> Case:
        ship = self.base.ship
        wave_length = self.length_ratio[r] * ship.length
        sea = {
            "kind": "regular",
            "wave_length": wave_length,
            "wave_height": self.steepness[h] * wave_length,
            "wave_heading_deg": 180.0,
        }
        run = {
            "run.speed_knots": self.froude[f] * float(np.sqrt(ship.gravity * ship.length)) / KNOT,
            "run.time_step": TIME_STEP,
            "run.ramp": RAMP,
            "run.duration": TRANSIENT + MEASURED,
        }
        return self.base.changed({"seaway": sea, **run, **self.changes})

    @property
    def cases(self) -> tuple[Case, ...]:
        """All runs."""
        return tuple(self.by_index.values())

    def read(self, store: RunStore) -> Measured:
        """The harmonics of the stored runs."""
        shape = (len(self.froude), len(self.length_ratio), len(self.steepness), 2)
        transfer = np.full(shape, np.nan, dtype=complex)
        mean, second, unsettled = np.full((3, *shape), np.nan)
        failures = []
        for index, case in self.by_index.items():
            failure = store.failure(case)
            run = store.load(case) if failure is None else None
            if run is None or run.early_end is not None:
                failures.append(f"{self.told(index)}: {failure if run is None else run.early_end}")
                continue
            found, scale = _harmonics(run, case), _scale(case)
            transfer[index] = found.complex_amplitude[0] / scale
            mean[index], second[index] = found.mean / scale, found.amplitude[1] / scale
            unsettled[index] = found.unsettled
        return Measured(transfer, mean, second, unsettled, tuple(failures))

    def told(self, index: tuple[int, ...]) -> str:
        """A run in words, by its indices; those that are left out at the end are not told."""
        names = ("Fn {:g}", "λ/L {:g}", "H/λ 1/{:.0f}")
        values = (self.froude, self.length_ratio, tuple(1.0 / value for value in self.steepness))
        return ", ".join(name.format(of[i]) for name, of, i in zip(names, values, index, strict=False))

    def linear(self) -> ComplexArray:
        """Heave over a and pitch over k a in the frequency domain (F, R, 2)."""
        wave_length = np.array(self.length_ratio) * self.base.ship.length
        order = np.argsort(-wave_length)
        frequency = np.sqrt(2.0 * np.pi * self.base.ship.gravity / wave_length)
        table = response(
            self.base.ship,
            self.base.database(),
            frequencies=frequency[order],
            wave_headings=[np.pi],
            speeds=[case.speed for (_, r, h), case in self.by_index.items() if r == h == 0],
            supplementary=self.base.supplementary,
        )
        found = np.empty((len(self.froude), len(wave_length), 2), dtype=complex)
        found[:, order] = table.transfer[:, 0][..., list(MODES)]
        found[..., 1] *= wave_length / (2.0 * np.pi)
        return found


def _harmonics(run: StoredRun, case: Case) -> Harmonics:
    """Mean and harmonics of heave and pitch, from the last of two windows."""
    signals = run.displacement[:, list(MODES)]
    return harmonics(run.time, signals, met_frequency(case), after=run.time[-1] - MEASURED)


def met_frequency(case: Case) -> float:
    """Signed frequency of encounter [rad/s] of the wave of a case."""
    waves = case.seaway.components
    met = encounter_frequency(waves.frequency, waves.wave_heading, case.speed, case.ship.gravity)
    return float(met[0])


def relative_difference(
    found: ComplexArray | FloatArray, reference: ComplexArray | FloatArray, linear: ComplexArray
) -> FloatArray:
    """Amplitude (F, R, …, 2) over that of a reference, less 1; NaN where the linear one (F, R, 2) is minor.

    The reference is one for each, or (F, R, 2) for all. Minor is what has less than 5 % of its peak over λ/L:
    beside a cancellation a difference says nothing.
    """
    minor = _minor(linear)
    spread = (slice(None), slice(None), *(None,) * (np.ndim(found) - 3))
    against = np.abs(reference if np.ndim(reference) == np.ndim(found) else reference[spread])
    return np.where(minor[spread], np.nan, np.abs(found) / against - 1.0)


def _minor(linear: ComplexArray) -> NDArray[np.bool_]:
    size = np.abs(linear)
    return np.asarray(size < MINOR * np.nanmax(size, axis=1, keepdims=True))


def left_out(runs: RegularRuns, found: Measured, linear: ComplexArray, steepness: float) -> str:
    """A sentence on what `relative_difference` leaves out, and how far it is off there; "" for nothing."""
    amplitude = np.abs(found.transfer[:, :, runs.steepness.index(steepness)])
    told = []
    for f, r, mode in np.argwhere(_minor(linear)):
        off = amplitude[f, r, mode] / np.abs(linear[f, r, mode]) - 1.0
        known = "" if np.isnan(off) else f" ({100 * off:+.0f} % at H/λ {steepness_told(steepness)})"
        told.append(f"{MODE_NAMES[mode]} at {runs.told((f, r))}{known}")
    if not told:
        return ""
    return (
        f" Differences leave out what is under {100 * MINOR:g} % of its peak over λ/L in the frequency"
        f" domain: {'; '.join(told)}."
    )


def worst(values: FloatArray) -> tuple[int, ...] | None:
    """Index of the value of the largest size; None where none is known."""
    if np.isnan(values).all():
        return None
    return tuple(int(i) for i in np.unravel_index(int(np.nanargmax(np.abs(values))), values.shape))


def steepness_told(steepness: float) -> str:
    """A steepness H/λ in words."""
    return f"1/{1 / steepness:.0f}"


def _scale(case: Case) -> FloatArray:
    """Wave amplitude and slope (2,) [m, rad]."""
    waves = case.seaway.components
    amplitude = float(waves.amplitude[0])
    return np.array([amplitude, amplitude * float(waves.wavenumber(case.ship.gravity)[0])])
