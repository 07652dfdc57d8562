"""The frequency domain against runs in time. Run: python benchmarks/frequency_comparison.py [--write]

First the linear model wave by wave: HALIFAX at 0, 10 and 20 knots, seven headings, nineteen frequencies, one
regular wave a run; the nonlinear model in small waves on some of them. Then RMS over many seeds against the
spectrum, from seeds_against_spectrum.py. `--write` puts frequency_domain.md and its plots into reports/.
"""

import argparse
import platform
from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt
from seeds_against_spectrum import seeds_section

import panelsim as ps
from panelsim.conventions import DOF_NAMES, ComplexArray, Dof, FloatArray
from panelsim.loads.radiation import Radiation
from panelsim.response.linear_ship import LinearShip
from panelsim.seaway.components import WaveComponents
from panelsim.seaway.given import ComponentSeaway
from panelsim.seaway.seaways import CalmSeaway, Seaway

REPORTS = Path(__file__).parents[1] / "reports"
KNOTS = (0, 10, 20)
HEADINGS = (180, 150, 120, 90, 60, 30, 0)  # deg
OMEGA = np.round(np.arange(0.2, 2.05, 0.1), 1)  # rad/s
FINE = np.linspace(0.2, 2.0, 361)  # rad/s, of the curves
TIME_STEP = 0.1  # s
# Yaw on its spring is slowest to settle, at rest with 1/97 s. At `SETTLED` it is down to 1 in 2000.
RAMP, SETTLED, END = 60.0, 800.0, 900.0  # s
AMPLITUDE = {"linear": 0.01, "nonlinear": 0.02}  # m
STEPS = (0.05, 0.1, 0.2, 0.4)  # s
NONLINEAR = (((20, 150), (0.4, 0.7, 1.0)), ((20, 30), (0.4, 0.9, 1.2)), ((0, 90), (0.4, 0.6, 0.9)))
ALLOWED = np.where(np.arange(6) == Dof.ROLL, 3.0, 2.0)  # % of the peak
LATERAL = (Dof.SWAY, Dof.ROLL, Dof.YAW)


@dataclass(frozen=True)
class Study:
    """The ship, her coefficients, springs and dampers."""

    ship: ps.Ship
    database: ps.HydroDatabase
    supplementary: ps.Supplementary

    def table(self, knots: float, degrees: float, omega: FloatArray) -> tuple[ComplexArray, FloatArray]:
        """Transfer functions (F, 6) and signed frequencies of encounter (F,) [rad/s]."""
        found = ps.response(
            self.ship,
            self.database,
            frequencies=omega,
            wave_headings=[np.deg2rad(degrees)],
            speeds=[knots * ps.KNOT],
            supplementary=self.supplementary,
        )
        return found.transfer[0, 0], found.encounter_frequency[0, 0]

    def by_memory(self, knots: float, degrees: float, omega: FloatArray) -> ComplexArray:
        """The table's motions (F, 6) with the radiation of the memory that runs in time have."""
        speed = knots * ps.KNOT
        linear = LinearShip(self.ship, self.database, self.supplementary)
        waves = linear.in_waves(
            omega, np.full(len(omega), np.deg2rad(degrees)), np.array([speed]), np.zeros(1)
        )
        memory = Radiation(self.database, [speed])
        states, coupling, load = memory.states, memory.coupling[0], waves.froude_krylov + waves.diffraction[0]
        motions = []
        for met, force in zip(waves.encounter[0], load, strict=True):
            rate = 1j * met * np.eye(6)
            answer = np.linalg.solve(1j * met * np.eye(states.count) - states.transition, states.entrance)
            inertia = memory.added_mass_infinite + states.momentum @ answer
            radiation = (rate - coupling.T) @ inertia @ (rate + coupling)
            bare = linear.stiffness + rate @ self.supplementary.damping_matrix - met**2 * self.ship.inertia
            motions.append(np.linalg.solve(radiation + bare, force))
        return np.array(motions)

    def runs(self, seas: list[Seaway], knots: float, **given: object) -> tuple[ps.History, ...]:
        """A batch at one speed."""
        return ps.simulate_batch(
            self.ship,
            seas,
            speed=knots * ps.KNOT,
            database=self.database,
            supplementary=self.supplementary,
            ramp=RAMP,
            **given,  # type: ignore[arg-type]
        )

    def in_time(
        self,
        knots: float,
        degrees: float,
        omega: FloatArray,
        time_step: float = TIME_STEP,
        model: str = "linear",
    ) -> tuple[ComplexArray, float]:
        """Complex motions (F, 6) per metre of wave from runs, and by how much they still change.

        Every wave is run twice, the second a quarter period later: the two motions are the real and the
        imaginary part of H exp(iω_e t), so that H is read at any instant, and where waves stand still
        beside the ship as well. What the ship does in calm water is taken off.
        """
        amplitude = AMPLITUDE[model]
        waves = [
            WaveComponents(*(np.array([v]) for v in (amplitude, w, np.deg2rad(degrees), phase)))
            for phase in (0.0, -0.5 * np.pi)
            for w in omega
        ]
        seas: list[Seaway] = [ComponentSeaway(wave) for wave in waves]
        histories = self.runs(
            [*seas, CalmSeaway()], knots, duration=END - RAMP, time_step=time_step, model=model
        )
        assert all(history.outcome == "finished" for history in histories)
        time = histories[0].time
        motion = np.array([h.displacement - histories[-1].displacement for h in histories[:-1]])
        first, second = np.split(motion[:, time >= SETTLED], 2)
        met = np.array([w.encounter_frequency(knots * ps.KNOT, self.ship.gravity)[0] for w in waves])
        turned = np.exp(-1j * np.outer(met[: len(omega)], time[time >= SETTLED]))
        read = (first + 1j * second) * turned[..., None] / amplitude
        mean = read.mean(axis=1)
        peak = np.abs(mean).max(axis=0)
        moving = peak > 1e-3 * peak.max()
        return mean, float((np.abs(read - mean[:, None]).max(axis=(0, 1)) / peak)[moving].max())


@dataclass(frozen=True)
class Comparison:
    """One speed and heading: transfer functions (F, 6) by both ways, frequencies of encounter (F,)."""

    knots: int
    degrees: int
    frequency_domain: ComplexArray
    by_memory: ComplexArray
    time_domain: ComplexArray
    encounter: FloatArray
    unsteady: float

    @property
    def peak(self) -> FloatArray:
        """Largest amplitude (6,) of each mode at this speed and heading; NaN where symmetry forbids it."""
        peak = np.abs(self.frequency_domain).max(axis=0)
        if self.degrees in (0, 180):
            peak[list(LATERAL)] = np.nan
        return peak

    @property
    def difference(self) -> FloatArray:
        """|time domain - frequency domain| (F, 6) [m/m, rad/m]: amplitude and phase count."""
        return np.abs(self.time_domain - self.frequency_domain) + 0.0 * self.peak

    @property
    def phase_difference(self) -> FloatArray:
        """Difference of phase (F, 6) [deg] where the amplitude is a tenth of the peak or more, else 0."""
        angle = np.abs(np.angle(self.time_domain * self.frequency_domain.conj(), deg=True))
        return np.where(np.abs(self.frequency_domain) >= 0.1 * self.peak, angle, 0.0)


def compared(study: Study, knots: int, degrees: int) -> Comparison:
    expected, encounter = study.table(knots, degrees, OMEGA)
    found, unsteady = study.in_time(knots, degrees, OMEGA)
    by_memory = study.by_memory(knots, degrees, OMEGA)
    return Comparison(knots, degrees, expected, by_memory, found, encounter, unsteady)


def peaks(found: list[Comparison], knots: int) -> FloatArray:
    """Largest amplitude (6,) of each mode at a speed, all headings."""
    return np.asarray(np.nanmax([one.peak for one in found if one.knots == knots], axis=0))


def row(*cells: object) -> str:
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def head(*cells: object) -> list[str]:
    return [row(*cells), "|---" * len(cells) + "|"]


def per_cent(values: FloatArray) -> list[str]:
    return ["-" if np.isnan(v) else f"{v:.3f}" for v in values]


def difference_table(found: list[Comparison]) -> list[str]:
    lines = head("knots", "heading", *DOF_NAMES, "phase, deg", "ω_e, rad/s")
    worst, by_memory = np.zeros(6), np.zeros(6)
    for one in found:
        scale = 100.0 / peaks(found, one.knots)
        here = one.difference.max(axis=0) * scale
        met = f"{one.encounter.min():.2f} to {one.encounter.max():.2f}"
        phase = f"{one.phase_difference.max():.2f}"
        lines.append(row(one.knots, f"{one.degrees}°", *per_cent(here), phase, met))
        worst = np.fmax(worst, here)
        by_memory = np.fmax(by_memory, np.abs(one.time_domain - one.by_memory).max(axis=0) * scale)
    return [
        *lines,
        row("all", "", *per_cent(worst), "", ""),
        row("allowed", "", *ALLOWED, "", ""),
        row("same memory in both", "", *per_cent(by_memory), "", ""),
    ]


def where_worst(found: list[Comparison]) -> list[str]:
    """By motion: where the difference is largest, and how large over the peak at one heading only."""
    lines = head(
        "motion",
        "worst, %",
        "knots",
        "heading",
        "ω, rad/s",
        "ω_e, rad/s",
        "over own peak, %",
        "at",
        "own peak",
    )
    for dof in Dof:
        values = np.array([100.0 * one.difference[:, dof] / peaks(found, one.knots)[dof] for one in found])
        case, wave = np.unravel_index(np.nanargmax(values), values.shape)
        one = found[case]
        own = np.array([100.0 * each.difference[:, dof].max() / each.peak[dof] for each in found])
        other = found[int(np.nanargmax(own))]
        place = (one.knots, f"{one.degrees}°", OMEGA[wave], f"{one.encounter[wave]:.3f}")
        at = (f"{other.knots} knots, {other.degrees}°", f"{other.peak[dof]:.3g}")
        lines.append(row(DOF_NAMES[dof], f"{values[case, wave]:.3f}", *place, f"{np.nanmax(own):.3f}", *at))
    return lines


def step_table(study: Study) -> list[str]:
    lines = head("knots, heading", "dt, s", *DOF_NAMES)
    for knots, degrees in ((20, 150), (20, 30)):
        omega = OMEGA[:12]
        expected, _ = study.table(knots, degrees, omega)
        for step in STEPS:
            found, _ = study.in_time(knots, degrees, omega, time_step=step)
            error = 100.0 * np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)
            lines.append(row(f"{knots}, {degrees}°", step, *per_cent(error)))
    return lines


def nonlinear_table(study: Study, known: list[Comparison]) -> list[str]:
    lines = head("knots, heading", "ω, rad/s", *DOF_NAMES)
    for (knots, degrees), frequencies in NONLINEAR:
        peak = peaks(known, knots)
        omega = np.array(frequencies)
        expected, _ = study.table(knots, degrees, omega)
        found, _ = study.in_time(knots, degrees, omega, model="nonlinear")
        error = 100.0 * np.abs(found - expected) / peak
        lines += [row(f"{knots}, {degrees}°", w, *per_cent(one)) for w, one in zip(omega, error, strict=True)]
    return lines


def plot(study: Study, found: list[Comparison], knots: int) -> None:
    """Amplitude and phase of all motions at one speed: lines and points; no phase of small motions."""
    cases = [one for one in found if one.knots == knots]
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, len(cases)))
    figure, axes = plt.subplots(4, 3, figsize=(14, 13), sharex=True, layout="constrained")
    for one, colour in zip(cases, colours, strict=True):
        curve, _ = study.table(knots, one.degrees, FINE)
        for dof in np.flatnonzero(np.isfinite(one.peak)):
            top = 2 * (dof // 3)
            label = f"{one.degrees}°"
            for omega, values, style in ((FINE, curve, "-"), (OMEGA, one.time_domain, "o")):
                given = {"color": colour, "markersize": 4, "label": label if style == "-" else None}
                axes[top, dof % 3].plot(omega, np.abs(values[:, dof]), style, **given)
                phase = np.angle(values[:, dof], deg=True)
                seen = np.abs(values[:, dof]) >= 0.1 * one.peak[dof]
                dots = style.replace("-", ".")
                size = 4 if dots == "o" else 1.5
                axes[top + 1, dof % 3].plot(omega[seen], phase[seen], dots, color=colour, markersize=size)
    for dof in Dof:
        axes[2 * (dof // 3), dof % 3].set_title(f"{DOF_NAMES[dof]}, {'m/m' if dof < 3 else 'rad/m'}")
        axes[2 * (dof // 3) + 1, dof % 3].set_ylabel("phase, deg")
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    for axis in axes[-1]:
        axis.set_xlabel("wave frequency, rad/s")
    axes[0, 2].legend(fontsize=7, title="heading", title_fontsize=7)
    figure.suptitle(f"{knots} knots: frequency domain (lines), linear runs in time (points)")
    figure.savefig(REPORTS / f"frequency_domain_{knots}_knots.png", dpi=80, metadata={"Software": None})


def page(study: Study, found: list[Comparison]) -> str:
    unsteady = max(one.unsteady for one in found)
    return "\n".join(
        [
            "# The frequency domain against runs in time",
            "",
            f"panelsim {ps.__version__}, numpy {np.__version__}, {platform.machine()};"
            " `python benchmarks/frequency_comparison.py --write`.",
            "",
            "## Transfer functions",
            "",
            "HALIFAX with her bundled coefficients, springs and dampers, linear model, default stepper, dt"
            f" {TIME_STEP} s; {len(OMEGA)} waves of {OMEGA[0]:g} to {OMEGA[-1]:g} rad/s, each in a run of"
            " its own, so that waves of one frequency of encounter are told apart. Each wave is run twice, a"
            " quarter period apart; the two motions are real and imaginary part of H exp(iω_e t). That gives"
            " H at every instant with ω_e signed, so that overtaken waves (ω_e < 0) and waves that all but"
            " stand still beside the ship (ω_e = 0.0006 rad/s) are compared as all others. Means from"
            f" {SETTLED:g} to {END:g} s; within them H changes by {100 * unsteady:.2g} % of its peak.",
            "",
            "Largest difference of the complex amplitudes over all waves, in per cent of the motion's peak at"
            " that speed; largest difference of phase where the amplitude is a tenth of the peak at that"
            " heading or more. Last, the same equations in the frequency domain with the radiation of the"
            " states that remember the waves in time: what is left then is the runs' own error.",
            "",
            *difference_table(found),
            "",
            *where_worst(found),
            "",
            *(f"![{knots} knots](frequency_domain_{knots}_knots.png)\n" for knots in KNOTS),
            "By time step, waves to 1.3 rad/s:",
            "",
            *step_table(study),
            "",
            "So neither the time step nor the runs limit the agreement, but the memory of the waves:"
            " retardation functions of finite length from damping at finitely many frequencies, and the"
            " exponentials that stand for them. It shows most in sway, roll and yaw near 0.5 rad/s of"
            " encounter, where the yaw of the ship on her spring has 2 to 3 % of critical damping at 0 and 10"
            " knots. In beam seas the ends of the ship, which are not alike, leave small surge and pitch;"
            " over these peaks the same difference is larger.",
            "",
            f"Nonlinear model in waves of {AMPLITUDE['nonlinear']} m, same measures by wave:",
            "",
            *nonlinear_table(study, found),
            "",
            *seeds_section(study.ship, study.database, study.supplementary),
        ]
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--write", action="store_true", help="write reports/frequency_domain.md and plots")
    arguments = parser.parse_args()
    ship = ps.load_ship("halifax", 2.5)
    study = Study(ship, ps.database_for(ship), ps.Supplementary.of(ship))
    found = [compared(study, knots, degrees) for knots in KNOTS for degrees in HEADINGS]
    text = page(study, found)
    print(text)
    if arguments.write:
        REPORTS.mkdir(exist_ok=True)
        for knots in KNOTS:
            plot(study, found, knots)
        (REPORTS / "frequency_domain.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
