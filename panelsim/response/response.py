"""Transfer functions of a ship by speed, wave heading and wave frequency, and her motions in a sea."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.errors import PanelsimError
from panelsim.files import write_whole
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.hydro.transom import Transom
from panelsim.loads.supplementary import Supplementary
from panelsim.response.arguments import (
    RollDamping,
    different_headings,
    different_speeds,
    point_of_ship,
    require_parts,
    rising_frequencies,
    terms_by_speed,
)
from panelsim.response.in_sea import in_sea
from panelsim.response.linear_ship import LinearShip, MotionsInWaves
from panelsim.response.notes import response_notes
from panelsim.response.signals import PointSignals, Signals, SixMotions
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.direction.spreading import Spreading
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.ship.ship import Ship

FORMAT = "panelsim response 1"
_CONVENTIONS = {
    "time_factor": "exp(+i encounter_frequency t), per metre of wave amplitude",
    "phase": "that of a crest at the centre of gravity at t = 0",
    "headings": "rad, direction that waves travel relative to the ship: 0 following, pi/2 from port, pi head",
    "axes": "translating earth axes: x forward, y to port, z up",
}
_BY_WAVE = ("speed", "wave_heading", "wave_frequency")


@dataclass(frozen=True, eq=False)
class TransferFunctions:
    """Linear signals of a ship in waves: a table of transfer functions, and statistics in any sea.

    `dataset` holds the complex `transfer` (speed, wave_heading, wave_frequency, signal) per metre of wave
    amplitude, exp(+iω_e t), and the signed `encounter_frequency` [rad/s]. Statistics in a sea do not read the
    table: the equations of motion are solved at the waves of that sea.
    """

    dataset: xr.Dataset
    linear_ship: LinearShip
    signals: Signals
    roll_damping: tuple[RollDampingTerms, ...]

    def __post_init__(self) -> None:
        for variable in self.dataset.variables.values():
            variable.values.setflags(write=False)

    @property
    def transfer(self) -> ComplexArray:
        """Complex amplitudes (S, H, F, K) per metre of wave amplitude."""
        return np.asarray(self.dataset["transfer"].values)

    @property
    def encounter_frequency(self) -> FloatArray:
        """Signed ω_e (S, H, F) [rad/s]."""
        return np.asarray(self.dataset["encounter_frequency"].values)

    @property
    def speeds(self) -> FloatArray:
        """Speeds (S,) [m/s]."""
        return np.asarray(self.dataset["speed"].values)

    @property
    def wave_headings(self) -> FloatArray:
        """Wave headings (H,) [rad]."""
        return np.asarray(self.dataset["wave_heading"].values)

    @property
    def wave_frequencies(self) -> FloatArray:
        """Wave frequencies (F,) [rad/s]."""
        return np.asarray(self.dataset["wave_frequency"].values)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what the figures do not hold; often none."""
        return tuple(str(self.dataset.attrs["notes"]).splitlines())

    def in_sea(
        self,
        sea: Seaway | PointSpectrum | DirectionalSpectrum,
        *,
        wave_headings: ArrayLike | None = None,
        ship_headings: ArrayLike | None = None,
        spreading: Spreading | None = None,
    ) -> xr.Dataset:
        """Statistics in a sea by speed, course and signal.

        A seaway is the sum of its components, Σ ½|H a|²; it is met on its own course or on the compass
        courses `ship_headings` (H,) [rad]. A point spectrum is long-crested along each of `wave_headings`
        β (H,) [rad], by default those of the table, or spread about it by `spreading`. A directional spectrum
        is met on `ship_headings`, by default 0. Spectra are integrated over wave frequency and direction.

        The dataset holds `rms`, `zero_crossing_period` 2π√(m0/m2) and `peak_period` [s] (speed, heading,
        signal), with moments m_n = ∫ |ω_e|ⁿ |H|² S dω, and `equivalent_roll_damping` [N m s] (speed,
        heading), which stands for quadratic and cubic roll damping in that sea. NaN where nothing moves, and
        for drift that nothing holds. Raises PanelsimError for seas of another kind and headings that do not
        belong to them, and where the coefficients do not reach.
        """
        headings = self.wave_headings if isinstance(sea, PointSpectrum) else None
        return in_sea(
            self.linear_ship,
            self.signals,
            self.speeds,
            self.roll_damping,
            sea,
            wave_headings=headings if wave_headings is None else wave_headings,
            ship_headings=ship_headings,
            spreading=spreading,
        )

    def rms(
        self,
        sea: Seaway | PointSpectrum | DirectionalSpectrum,
        *,
        wave_headings: ArrayLike | None = None,
        ship_headings: ArrayLike | None = None,
        spreading: Spreading | None = None,
    ) -> xr.DataArray:
        """RMS (speed, heading, signal) in a sea; arguments as in `in_sea`."""
        found = self.in_sea(
            sea, wave_headings=wave_headings, ship_headings=ship_headings, spreading=spreading
        )
        return found["rms"]

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write NetCDF-4, complex values as two variables, `…_real` and `…_imag`.

        An existing file is refused unless `overwrite`.
        """
        path = Path(path)
        if path.exists() and not overwrite:
            raise PanelsimError(
                "The response would overwrite a file", got=path, remedy="give another name or overwrite=True"
            )
        write_whole(path, bytes(real_valued(self.dataset).to_netcdf(engine="h5netcdf")))
        return path


@dataclass(frozen=True, eq=False)
class Response(TransferFunctions):
    """Transfer functions of the six motions at the centre of gravity, signal = surge … yaw.

    Besides them the `dataset` has the loads `froude_krylov` (wave_heading, wave_frequency, signal) and
    `diffraction` (speed, wave_heading, wave_frequency, signal) per metre of wave amplitude [N/m, N].
    """

    def at(self, point: ArrayLike) -> TransferFunctions:
        """What a point of the ship does: `point` (3,) [m] in hull axes (midships, centreline, baseline).

        The signals are displacement_x … acceleration_z and relative_motion, as in `PointSignals`. Raises
        PanelsimError for what is no point.
        """
        ship = self.linear_ship.ship
        place = point_of_ship(point)
        signals = PointSignals(ship.to_ship_axes(place), ship.gravity)
        by_wave = np.broadcast_to(self.wave_frequencies, self.encounter_frequency.shape)
        headings = np.broadcast_to(self.wave_headings[:, None], self.encounter_frequency.shape)
        transfer = signals.of(self.transfer, by_wave, headings, self.encounter_frequency)
        dataset = xr.Dataset(
            {
                "transfer": ((*_BY_WAVE, "signal"), transfer),
                "encounter_frequency": (_BY_WAVE, self.encounter_frequency.copy()),
            },
            coords=_coordinates(self.speeds, self.wave_headings, self.wave_frequencies, signals),
            attrs=self.dataset.attrs | {"point": place.tolist()},
        )
        return TransferFunctions(dataset, self.linear_ship, signals, self.roll_damping)


def response(
    ship: Ship,
    database: HydroDatabase,
    *,
    frequencies: ArrayLike,
    wave_headings: ArrayLike,
    speeds: ArrayLike,
    supplementary: Supplementary | None = None,
    roll_damping: RollDamping = None,
    transom: Transom | None = None,
) -> Response:
    """Solve the linear equations of motion for waves of all frequencies and headings at all speeds.

    `frequencies` ω (F,) [rad/s], rising; `wave_headings` β (H,) [rad], 0 following, π head; `speeds` (S,)
    [m/s]. `roll_damping` is one for all speeds or one for each; transfer functions have its linear term,
    motions in a sea all of it. With a `transom`, the end terms of Salvesen, Tuck and Faltinsen (1970).

    Raises PanelsimError for arguments of another kind or out of range, for a database of another ship, for
    waves that the diffraction tables of a foreign database do not hold, and where a wave stands still beside
    a ship that nothing holds. Waves that meet the ship faster than the coefficients resolve are noted.
    """
    require_parts(ship, database, supplementary, transom)
    omega = rising_frequencies(frequencies)
    beta = different_headings("wave heading", wave_headings)
    speed = different_speeds(speeds)
    terms = terms_by_speed(roll_damping, len(speed))
    linear = LinearShip(ship, database, Supplementary() if supplementary is None else supplementary, transom)
    waves = np.stack(np.meshgrid(omega, beta), axis=-1).reshape(-1, 2)
    motions = linear.in_waves(waves[:, 0], waves[:, 1], speed, np.array([term.linear for term in terms]))
    dataset = _dataset(motions, omega, beta, speed)
    dataset.attrs |= {
        "format": FORMAT,
        "ship": ship.name,
        **_CONVENTIONS,
        "notes": "\n".join(response_notes(linear, motions, speed)),
    }
    return Response(dataset, linear, SixMotions(), terms)


def _dataset(motions: MotionsInWaves, omega: FloatArray, beta: FloatArray, speed: FloatArray) -> xr.Dataset:
    shape = (len(speed), len(beta), len(omega))
    by_signal = (*_BY_WAVE, "signal")
    return xr.Dataset(
        {
            "transfer": (by_signal, motions.transfer.reshape(*shape, 6)),
            "froude_krylov": (by_signal[1:], motions.froude_krylov.reshape(*shape[1:], 6)),
            "diffraction": (by_signal, motions.diffraction.reshape(*shape, 6)),
            "encounter_frequency": (_BY_WAVE, motions.encounter.reshape(shape), {"units": "rad/s"}),
        },
        coords=_coordinates(speed, beta, omega, SixMotions()),
    )


def _coordinates(
    speed: FloatArray, beta: FloatArray, omega: FloatArray, signals: Signals
) -> dict[str, tuple[str, Sequence[str] | FloatArray] | tuple[str, FloatArray, dict[str, str]]]:
    return {
        "speed": ("speed", speed.copy(), {"units": "m/s"}),
        "wave_heading": ("wave_heading", beta.copy(), {"units": "rad"}),
        "wave_frequency": ("wave_frequency", omega.copy(), {"units": "rad/s"}),
        "signal": ("signal", list(signals.names)),
        "unit": ("signal", list(signals.units)),
    }


def real_valued(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset with every complex variable as two, `…_real` and `…_imag`: NetCDF has no complex type."""
    complex_names = [str(name) for name, values in dataset.items() if np.iscomplexobj(values)]
    parts: dict[str, xr.DataArray] = {}
    for name in complex_names:
        parts |= {f"{name}_real": dataset[name].real, f"{name}_imag": dataset[name].imag}
    return dataset.drop_vars(complex_names).assign(parts)
