"""A ship, a sea, a run and its statistics: from nothing to numbers in ten lines."""

import numpy as np

import panelsim as ps

ship = ps.load_ship("halifax", panel_area=10.0)
sea = ps.RandomSeaway(ps.Bretschneider(7.5, 15.0), np.arange(0.2, 2.0, 0.05), np.deg2rad(150), seed=1001)
history = ps.simulate(
    ship,
    sea,
    speed=20 * ps.KNOT,
    duration=300,
    time_step=0.2,
    database=ps.database_for(ship),
    supplementary=ps.Supplementary.of(ship),  # autopilot, engine and viscous roll damping
)
motions = ps.statistics(history).motions

if __name__ == "__main__":
    print(f"heave RMS {motions['heave'].rms:.2f} m, pitch RMS {np.rad2deg(motions['pitch'].rms):.2f}°")
