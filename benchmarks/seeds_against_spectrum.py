"""RMS over many seeds against the spectrum. Run: python benchmarks/seeds_against_spectrum.py

Linear runs of HALIFAX at 20 knots in sea state 7, jittered frequencies, bow, beam and quartering
seas. How far their mean may lie from the spectral value is found from theory before any run.
frequency_comparison.py puts the tables into its report.
"""

import argparse

import numpy as np

import panelsim as ps
from panelsim.conventions import DOF_NAMES, FloatArray
from panelsim.response.sampling import variance_scatter

SEEDS, DRAWS = 20, 1000
TIME_STEP, RAMP, SETTLED, DURATION = 0.2, 60.0, 350.0, 1800.0  # s; transients have died at `SETTLED`
SPEED = 20 * ps.KNOT
SEA = ps.Bretschneider(7.5, 15.0)
CHOICE = ps.JitteredFrequencies(0.2, 2.0, 0.025)
HEADINGS = (150, 90, 60, 30)  # deg


def row(name: str, values: FloatArray, form: str) -> str:
    return f"| {name} | " + " | ".join(form.format(v) for v in values) + " |"


class Seas:
    """Seas from one heading: what is to be expected of runs in them."""

    def __init__(self, table: ps.Response, heading: float) -> None:
        self.heading = heading
        self.omega = table.wave_frequencies
        self.gain = np.abs(table.transfer[0, 0]) ** 2
        self.gravity = table.linear_ship.ship.gravity

    def draw(self, seed: int) -> ps.RandomSeaway:
        return ps.RandomSeaway(SEA, CHOICE, self.heading, seed=seed)

    @property
    def spectral(self) -> FloatArray:
        """Variance (6,) of the spectrum within the bins of the frequencies."""
        density = self.gain * SEA.density(self.omega)[:, None]
        return np.asarray(np.trapezoid(density, self.omega, axis=0))

    def expected(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Of a run's variance (6,): its mean, its scatter by the phases, and by the draw of frequencies."""
        carried, scatter = [], []
        for seed in range(10_000, 10_000 + DRAWS):
            waves = self.draw(seed).components
            gain = np.array([np.interp(waves.frequency, self.omega, of_mode) for of_mode in self.gain.T]).T
            variance = 0.5 * gain * waves.amplitude[:, None] ** 2
            met = waves.encounter_frequency(SPEED, self.gravity)
            carried.append(variance.sum(axis=0))
            scatter.append(variance_scatter(met, variance, DURATION))
        mean = np.mean(carried, axis=0)
        return mean, np.sqrt(np.mean(scatter, axis=0)), np.std(carried, axis=0)


def table_of_heading(
    ship: ps.Ship, database: ps.HydroDatabase, supplementary: ps.Supplementary, degrees: int
) -> list[str]:
    fine = np.linspace(CHOICE.start - 0.5 * CHOICE.step, CHOICE.stop + 0.5 * CHOICE.step, 4001)
    given = {"speeds": [SPEED], "supplementary": supplementary}
    heading = np.deg2rad(degrees)
    seas = Seas(ps.response(ship, database, frequencies=fine, wave_headings=[heading], **given), heading)
    histories = ps.simulate_batch(
        ship,
        [seas.draw(seed) for seed in range(SEEDS)],
        speed=SPEED,
        duration=SETTLED - RAMP + DURATION,
        ramp=RAMP,
        time_step=TIME_STEP,
        database=database,
        model="linear",
        supplementary=supplementary,
    )
    measured = np.array([(h.displacement[h.time >= SETTLED] ** 2).mean(axis=0) for h in histories])
    spectral, (carried, by_phases, by_draw) = seas.spectral, seas.expected()
    one_run = np.hypot(by_phases, by_draw)
    error = one_run / np.sqrt(SEEDS)
    found = measured.mean(axis=0)
    half = 50.0 / spectral  # % of the RMS, of a small difference of variances
    return [
        f"| 20 knots, {degrees}° | " + " | ".join(DOF_NAMES) + " |",
        "|---" * 7 + "|",
        row("RMS of the spectrum, m or rad", np.sqrt(spectral), "{:.4g}"),
        row("RMS of the runs, m or rad", np.sqrt(found), "{:.4g}"),
        row("difference, %", 100.0 * (np.sqrt(found / spectral) - 1.0), "{:+.3f}"),
        row("sampling error of the mean of all runs, %", half * error, "{:.3f}"),
        row("z", (found - spectral) / error, "{:+.2f}"),
        row("sampling error of one run, %", half * one_run, "{:.2f}"),
        row("of it by the phases, %", half * by_phases, "{:.2f}"),
        row("of it by the draw of frequencies, %", half * by_draw, "{:.2f}"),
        row("scatter of the runs, %", half * measured.std(axis=0, ddof=1), "{:.2f}"),
        row("components less spectrum, %", half * (carried - spectral), "{:+.3f}"),
        "",
    ]


def seeds_section(ship: ps.Ship, database: ps.HydroDatabase, supplementary: ps.Supplementary) -> list[str]:
    """The tables of all headings, in Markdown, and what is in them."""
    tables = [table_of_heading(ship, database, supplementary, degrees) for degrees in HEADINGS]
    return [
        "## RMS over seeds",
        "",
        f"{SEEDS} linear runs of {DURATION:g} s at 20 knots, H_s 7.5 m, T_p 15 s (Bretschneider), jittered"
        f" frequencies {CHOICE.start:g} to {CHOICE.stop:g} rad/s by {CHOICE.step:g}, dt {TIME_STEP} s."
        " The variance of a run scatters by its phases (`variance_scatter`: pairs of waves that it is too"
        " short to tell apart) and by its draw of frequencies. Both are found before any run, from theory"
        f" and {DRAWS} other draws, and added. z is the difference of the mean variance from that of the"
        " spectrum, over the sampling error. All is in per cent of the RMS; the spectrum counts within the"
        " bins of the frequencies. In stern quartering and following seas many waves share nearly one"
        " frequency of encounter, and no run is long enough to tell them apart. In bow seas most of the"
        " scatter is that of few draws, in which two large waves are close together: twenty runs often show"
        " less. In beam seas next to nothing is left of surge and pitch, and what the memory of the waves"
        " misses of it (see above) shows: their z is no matter of chance.",
        "",
        *(line for table in tables for line in table),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.parse_args()
    ship = ps.load_ship("halifax", 2.5)
    print("\n".join(seeds_section(ship, ps.database_for(ship), ps.Supplementary.of(ship))))


if __name__ == "__main__":
    main()
