"""A table of transfer functions by speed, wave heading and wave frequency, and the statistics of a sea."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from panelsim.conventions import ComplexArray, FloatArray
from panelsim.files import as_path, require_new, write_whole
from panelsim.hydro.roll_damping.terms import RollDampingTerms
from panelsim.response.in_sea import in_sea
from panelsim.response.linear_ship import LinearShip
from panelsim.response.signals import Signals
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.direction.spreading import Spreading
from panelsim.seaway.seaways import Seaway
from panelsim.seaway.spectra.point_spectrum import PointSpectrum


@dataclass(frozen=True, eq=False)
class TransferFunctions:
    """Linear signals of a ship in waves: a table of transfer functions, and statistics in any sea.

    `dataset` holds the complex `transfer` (speed, wave_heading, wave_frequency, signal) per metre of wave
    amplitude, exp(+iω_e t), the signed `encounter_frequency` [rad/s], and the linear `roll_damping` (speed,
    wave_heading) [N m s] that is in them beside the supplementary one. Statistics in a sea do not read the
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
        path = as_path(path)
        require_new(path, "response", overwrite=overwrite)
        write_whole(path, bytes(real_valued(self.dataset).to_netcdf(engine="h5netcdf")))
        return path


def real_valued(dataset: xr.Dataset) -> xr.Dataset:
    """The dataset with every complex variable as two, `…_real` and `…_imag`: NetCDF has no complex type."""
    complex_names = [str(name) for name, values in dataset.items() if np.iscomplexobj(values)]
    parts: dict[str, xr.DataArray] = {}
    for name in complex_names:
        whole = dataset[name]
        for short, long, part in (("real", "real", whole.real), ("imag", "imaginary", whole.imag)):
            long_name = f"{long} part of {whole.attrs.get('long_name', name)}"
            parts[f"{name}_{short}"] = part.assign_attrs(whole.attrs | {"long_name": long_name})
    return dataset.drop_vars(complex_names).assign(parts)
