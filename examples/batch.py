"""The same ship in many seas at once: what of her roll is due to the heading, and what to chance."""

import numpy as np

import panelsim as ps

ship = ps.load_ship("halifax", panel_area=10.0)
spectrum = ps.Bretschneider(5.0, 12.0)
headings = np.deg2rad([165.0, 135.0, 105.0])
seeds = [1, 2, 3, 4]
cases = [(heading, seed) for heading in headings for seed in seeds]
histories = ps.simulate_batch(
    ship,
    [
        ps.RandomSeaway(spectrum, ps.JitteredFrequencies(0.3, 1.6, 0.05), heading, seed=seed)
        for heading, seed in cases
    ],
    speed=15 * ps.KNOT,  # or one for each sea
    seeds=[seed for _, seed in cases],
    duration=120,
    time_step=0.2,
    database=ps.database_for(ship),
    supplementary=ps.Supplementary.of(ship),
)
# RMS of roll [rad], a row for each heading and a column for each seed.
roll = np.array([ps.statistics(history).motions["roll"].rms for history in histories]).reshape(3, 4)

if __name__ == "__main__":
    for heading, row in zip(np.rad2deg(headings), np.rad2deg(roll), strict=True):
        print(f"{heading:.0f}°: roll RMS {row.mean():.2f}°, from seed to seed {row.std(ddof=1):.2f}°")
