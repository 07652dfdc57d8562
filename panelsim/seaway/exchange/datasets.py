"""Spectra of wave models and buoys as the package wavespectra holds them, to and from ours.

Its layout is an xarray Dataset with `efth(time, site, freq, dir)` [m²/Hz/degree], frequencies in Hz and
compass directions in degrees that waves come from. Ours per rad/s and radian: S(ω, ν) = E(f, θ)/(2π)·(180/π)
with ω = 2πf, and S(ω) = E(f)/(2π) without directions.
"""

from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.seaway.direction.directional_spectrum import DirectionalSpectrum
from panelsim.seaway.direction.directional_table import DirectionalTable
from panelsim.seaway.exchange.choice import Moment, chosen_place
from panelsim.seaway.spectra.point_spectrum import PointSpectrum
from panelsim.seaway.spectra.table import TableSpectrum

HERTZ = 2 * np.pi  # rad/s
PER_DEGREE = 180.0 / np.pi  # of a density in degrees to one in radians

# Spellings as _plain leaves them. Wave models give frequencies in s-1 and mean Hz.
_UNITS = {
    "freq": {"hz", "s-1", "1/s"},
    "dir": {"degree", "degrees", "deg"},
    "efth": {"m2sdegree-1", "m2sdeg-1", "m2hz-1degree-1", "m2hz-1deg-1", "m2/hz/degree", "m2/hz/deg"},
    "efth without dir": {"m2s", "m2hz-1", "m2/hz"},
}


def spectrum_from_dataset(
    dataset: xr.Dataset, *, time: Moment | None = None, site: object = None
) -> DirectionalTable | TableSpectrum:
    """One spectrum of a dataset in wavespectra's layout; without the dimension `dir` a point spectrum.

    `time` (UTC) and `site` are values of those coordinates and must be given where there are several. What
    wavespectra's readers leave without units has those of the layout. The directions are those that
    waves come from whatever `standard_name` says: wavespectra turns them and leaves the name of the file.

    Raises PanelsimError for another layout or other units, a choice left open, frequencies that do not
    rise, and densities that are negative or missing, naming the first.
    """
    density = _only_spectrum(_require_layout(dataset), time, site)
    frequency = np.asarray(density["freq"].values, dtype=float)
    _require_rising(frequency)
    if "dir" not in density.dims:
        values = np.asarray(density.values, dtype=float)
        _require_densities(values, frequency, None)
        return TableSpectrum(HERTZ * frequency, values / HERTZ)
    direction = np.asarray(density["dir"].values, dtype=float)
    values = np.asarray(density.transpose("freq", "dir").values, dtype=float)
    _require_densities(values, frequency, direction)
    around = np.deg2rad(np.remainder(direction, 360.0))
    return DirectionalTable(HERTZ * frequency, around, values * PER_DEGREE / HERTZ)


def open_spectrum(
    path: str | Path, *, time: Moment | None = None, site: object = None
) -> DirectionalTable | TableSpectrum:
    """One spectrum of a NetCDF file in wavespectra's layout, arguments as in `spectrum_from_dataset`.

    Files of wave models in layouts of their own are read with wavespectra (read_ww3, read_era5 …), and what
    that gives with `spectrum_from_dataset`. Raises PanelsimError for files that are no NetCDF, and as there.
    """
    try:
        dataset = xr.open_dataset(path)
    except (OSError, ValueError) as error:
        raise PanelsimError(
            "The file of wave spectra cannot be read",
            # xarray's ValueError lists what other files it could read.
            got=path if isinstance(error, ValueError) else f"{path} ({str(error).splitlines()[0][:100]})",
            allowed="a NetCDF file with efth(time, site, freq, dir)",
        ) from error
    with dataset:
        return spectrum_from_dataset(dataset, time=time, site=site)


def dataset_from_spectrum(
    spectrum: DirectionalSpectrum | PointSpectrum,
    frequency: ArrayLike | None = None,
    sea_direction: ArrayLike | None = None,
) -> xr.Dataset:
    """A spectrum as a dataset `efth(freq, dir)`, or `efth(freq)` of a point spectrum, for wavespectra.

    At frequencies (F,) [rad/s] and directions (D,) [rad] that waves come from; a table may leave them out
    and gives its own. wavespectra integrates with the first step of direction over the circle: only even
    directions around the whole of it are taken. Raises PanelsimError for others, for frequencies that do
    not rise, and where either is missing, or not of use.
    """
    from wavespectra.core.attributes import attrs

    table = spectrum if isinstance(spectrum, DirectionalTable | TableSpectrum) else None
    omega = _grid("frequency", frequency, None if table is None else table.frequency)
    _require_rising(omega / HERTZ)
    coordinates = {"freq": omega / HERTZ}
    if isinstance(spectrum, DirectionalSpectrum):
        own = spectrum.sea_direction if isinstance(spectrum, DirectionalTable) else None
        direction = np.sort(_grid("sea_direction", sea_direction, own))
        _require_even_circle(direction)
        density = spectrum.density(omega[:, None], direction) * HERTZ / PER_DEGREE
        coordinates["dir"] = np.rad2deg(direction)
    elif sea_direction is None:
        density = spectrum.density(omega) * HERTZ
    else:
        raise PanelsimError("A point spectrum has no directions", got="sea_direction", remedy="leave it out")
    dataset = xr.Dataset({"efth": (tuple(coordinates), density)}, coordinates)
    for name in dataset.variables:
        dataset[name].attrs = attrs.ATTRS[name]
    if "dir" not in coordinates:
        dataset["efth"].attrs = attrs.ATTRS["ef"]
    return dataset


def _require_layout(dataset: xr.Dataset) -> xr.DataArray:
    """The variable efth; refuses a dataset that is not in wavespectra's layout and units."""
    if not isinstance(dataset, xr.Dataset) or "efth" not in dataset or "freq" not in dataset["efth"].dims:
        held = list(dataset.variables) if isinstance(dataset, xr.Dataset) else type(dataset).__name__
        raise PanelsimError(
            "The dataset is not in wavespectra's layout",
            got=str(held)[:120],
            allowed="an xarray Dataset with efth(time, site, freq, dir)",
            remedy="read the file with wavespectra, for example wavespectra.read_ww3",
        )
    density = dataset["efth"]
    for name in density.dims:
        if name in ("freq", "dir") and name not in density.coords:
            raise PanelsimError(
                f"The dataset does not give the values of {name}", allowed="a coordinate of it"
            )
    if "dir" in density.coords and density.sizes.get("dir", 1) == 1:
        raise PanelsimError(
            "The dataset holds one direction, of a directional spectrum or of a whole one",
            got=f"dir = {density['dir'].values}",
            allowed="all directions, or no dir",
            remedy='dataset.isel(dir=0, drop=True) if efth is in m²/Hz, and "units" of efth "m2 s"',
        )
    _require_units("freq", density["freq"], _UNITS["freq"])
    if "dir" in density.dims:
        _require_units("dir", density["dir"], _UNITS["dir"])
    _require_units("efth", density, _UNITS["efth" if "dir" in density.dims else "efth without dir"])
    return density


def _require_units(name: str, variable: xr.DataArray, allowed: set[str]) -> None:
    """Refuse units that are given and are not wavespectra's."""
    units = variable.attrs.get("units")
    plain = str(units).translate(str.maketrans("", "", " .*^{}")).lower()
    if units is not None and plain not in allowed:
        raise PanelsimError(
            f"The dataset's {name} is not in wavespectra's units",
            got=repr(units),
            allowed=" | ".join(sorted(allowed)),
            remedy=f"convert the values, or set the attribute units of {name} right",
        )


def _only_spectrum(density: xr.DataArray, time: Moment | None, site: object) -> xr.DataArray:
    """The one spectrum efth(freq, dir) that is chosen."""
    for name, wanted in (("time", time), ("site", site)):
        if name in density.dims:
            density = density.isel({name: chosen_place(name, density[name].values, wanted)})
        elif wanted is not None:
            raise PanelsimError(f"The dataset has no {name} to choose from", got=f"{name}={wanted!r}")
    for name in map(str, density.dims):
        if name not in ("freq", "dir"):
            if density.sizes[name] != 1:
                raise PanelsimError(
                    "The dataset holds more than one spectrum",
                    got=f"{density.sizes[name]} along {name}",
                    remedy=f"choose one, for example dataset.isel({name}=0)",
                )
            density = density.isel({name: 0})
    return density


def _require_rising(frequency: FloatArray) -> None:
    """Refuse frequencies [Hz] that do not rise from above 0."""
    if not (
        frequency.size and frequency[0] > 0 and np.all(np.diff(frequency) > 0) and frequency[-1] < np.inf
    ):
        raise PanelsimError(
            "The frequencies of the spectrum do not rise from above 0", got=f"{frequency} Hz"[:200]
        )


def _require_densities(values: FloatArray, frequency: FloatArray, direction: FloatArray | None) -> None:
    """Refuse densities that are negative or missing; names the first."""
    bad = np.argwhere(~(np.isfinite(values) & (values >= 0)))
    if len(bad):
        first = tuple(bad[0])
        where = f"{frequency[first[0]]:g} Hz"
        if direction is not None:
            where += f" from {direction[first[1]]:g}°"
        raise PanelsimError(
            "The spectrum is negative or missing somewhere",
            got=f"{values[first]:g} at {where}, and {len(bad)} of {values.size} in all",
            allowed="0 or more everywhere",
        )


def _grid(name: str, given: ArrayLike | None, own: FloatArray | None) -> FloatArray:
    """The grid that is given, or the spectrum's own."""
    chosen = own if given is None else given
    if chosen is None:
        raise PanelsimError(f"The spectrum has no {name} of its own", remedy=f"give {name}")
    try:
        grid = np.atleast_1d(np.asarray(chosen, dtype=float))
    except (TypeError, ValueError):
        grid = np.array([np.nan])
    if grid.ndim != 1 or not np.isfinite(grid).all():
        raise PanelsimError(f"The {name} is no list of finite numbers", got=repr(given)[:60])
    return grid


def _require_even_circle(direction: FloatArray) -> None:
    """Refuse directions [rad] that are not even around the circle."""
    around = np.diff(np.append(direction, direction[0] + 2 * np.pi))
    # Degrees printed with three digits are even.
    if len(direction) < 2 or np.ptp(around) > 1e-4:
        raise PanelsimError(
            "The directions are not even around the circle",
            got=f"steps of {np.rad2deg(around.min()):g}° to {np.rad2deg(around.max()):g}°",
            allowed="one step, over the whole circle",
            remedy="give sea_direction, for example np.deg2rad(np.arange(0, 360, 10))",
        )
