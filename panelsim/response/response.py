"""The linear response of a ship: transfer functions by speed, wave heading and wave frequency."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from panelsim.conventions import FloatArray
from panelsim.errors import PanelsimError
from panelsim.hydro.database import HydroDatabase
from panelsim.hydro.transom import Transom
from panelsim.loads.supplementary import Supplementary
from panelsim.response.arguments import (
    RollDamping,
    different_headings,
    different_speeds,
    require_parts,
    rising_frequencies,
    terms_by_speed,
)
from panelsim.response.linear_ship import LinearShip, MotionsInWaves
from panelsim.response.notes import response_notes
from panelsim.response.origin import made_from
from panelsim.response.signals import PointSignals, Signals, SixMotions, units_by_signal
from panelsim.response.transfer_functions import TransferFunctions
from panelsim.seaway.checks import real_numbers
from panelsim.ship.points import point_of_ship
from panelsim.ship.ship import Ship

FORMAT = "panelsim response 1"
_CONVENTIONS = {
    "time_factor": "exp(+i encounter_frequency t), per metre of wave amplitude",
    "phase": "that of a crest at the centre of gravity at t = 0",
    "headings": "rad, direction that waves travel relative to the ship: 0 following, pi/2 from port, pi head",
    "axes": "translating earth axes: x forward, y to port, z up",
}
_LOAD_UNITS = "N/m: surge, sway, heave; N m/m: roll, pitch, yaw"
_BY_WAVE = ("speed", "wave_heading", "wave_frequency")


@dataclass(frozen=True, eq=False)
class Response(TransferFunctions):
    """Transfer functions of the six motions at the centre of gravity, signal = surge … yaw.

    Besides them the `dataset` has the loads `froude_krylov` (wave_heading, wave_frequency, signal) and
    `diffraction` (speed, wave_heading, wave_frequency, signal) per metre of wave amplitude [N/m, N].
    `motions` are those of the same waves with the linear terms of the roll damping.
    """

    motions: MotionsInWaves

    def with_roll_damping(self, damping: ArrayLike) -> "Response":
        """The table with linear roll damping (S, H) [N m s] in place of the linear terms.

        `damping` may be the `equivalent_roll_damping` of a sea on the headings of the table, and is then what
        stands for quadratic and cubic terms there. Motions in a sea go on to find their own. Raises
        PanelsimError for values that are not one for each speed and heading, none below 0.
        """
        shape = self.transfer.shape[:2]
        wanted = real_numbers("roll damping", damping)
        if wanted.shape != shape or not (np.isfinite(wanted).all() and (wanted >= 0.0).all()):
            raise PanelsimError(
                "The roll damping is not one for each speed and heading",
                got=f"{wanted.shape} values, {np.array2string(wanted, threshold=4)}",
                allowed=f"{shape}, each 0 N m s or more",
            )
        transfer = np.empty_like(self.transfer)
        count = len(self.wave_frequencies)
        for i, j in np.ndindex(shape):
            more = float(wanted[i, j]) - self.roll_damping[i].linear
            waves = slice(j * count, (j + 1) * count)
            transfer[i, j] = self.motions.more_roll_damping(i, waves, more)
        dataset = self.dataset.assign(
            transfer=self.dataset["transfer"].copy(data=transfer),
            roll_damping=self.dataset["roll_damping"].copy(data=wanted),
        )
        return replace(self, dataset=dataset)

    def at(self, point: ArrayLike) -> TransferFunctions:
        """What a point of the ship does: `point` (3,) [m] in hull axes (midships, centreline, baseline).

        The signals are displacement_x … acceleration_z and relative_motion, as in `PointSignals`. Raises
        PanelsimError for what is no point.
        """
        ship = self.linear_ship.ship
        place = point_of_ship(point, ship.center_of_gravity, ship.vertices)
        signals = PointSignals(ship.to_ship_axes(place), ship.gravity)
        by_wave = np.broadcast_to(self.wave_frequencies, self.encounter_frequency.shape)
        headings = np.broadcast_to(self.wave_headings[:, None], self.encounter_frequency.shape)
        transfer = signals.of(self.transfer, by_wave, headings, self.encounter_frequency)
        dataset = xr.Dataset(
            {
                "transfer": ((*_BY_WAVE, "signal"), transfer, _transfer_attrs(signals)),
                "encounter_frequency": self.dataset["encounter_frequency"].copy(),
                "roll_damping": self.dataset["roll_damping"].copy(),
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

    Raises PanelsimError for arguments of another kind or out of range, for a database or a transom of another
    ship, for waves that the diffraction tables of a foreign database do not hold, and where a wave stands
    still beside a ship that nothing holds. Waves that meet the ship faster than the coefficients resolve are
    noted.
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
    by_course = np.repeat([[term.linear] for term in terms], len(beta), axis=1)
    dataset["roll_damping"] = (
        ("speed", "wave_heading"),
        by_course,
        {"units": "N m s", "long_name": "linear roll damping in the transfer functions"},
    )
    dataset.attrs |= {
        "format": FORMAT,
        **made_from(linear, speed, terms),
        **_CONVENTIONS,
        "notes": "\n".join(response_notes(linear, motions, speed)),
    }
    return Response(dataset, linear, SixMotions(), terms, motions)


def _dataset(motions: MotionsInWaves, omega: FloatArray, beta: FloatArray, speed: FloatArray) -> xr.Dataset:
    shape = (len(speed), len(beta), len(omega))
    by_signal = (*_BY_WAVE, "signal")
    return xr.Dataset(
        {
            "transfer": (by_signal, motions.transfer.reshape(*shape, 6), _transfer_attrs(SixMotions())),
            "froude_krylov": (
                by_signal[1:],
                motions.froude_krylov.reshape(*shape[1:], 6),
                {"units": _LOAD_UNITS, "long_name": "Froude-Krylov load per metre of wave amplitude"},
            ),
            "diffraction": (
                by_signal,
                motions.diffraction.reshape(*shape, 6),
                {"units": _LOAD_UNITS, "long_name": "diffraction load per metre of wave amplitude"},
            ),
            "encounter_frequency": (
                _BY_WAVE,
                motions.encounter.reshape(shape),
                {"units": "rad/s", "long_name": "encounter frequency, below 0 where the ship overtakes"},
            ),
        },
        coords=_coordinates(speed, beta, omega, SixMotions()),
    )


def _transfer_attrs(signals: Signals) -> dict[str, str]:
    return {
        "units": units_by_signal(signals, per="/m"),
        "long_name": "transfer function per metre of wave amplitude",
    }


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
