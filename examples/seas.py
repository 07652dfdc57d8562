"""Seas without a run: what spectra amount to, which seas occur, and how a ship that turns meets one."""

import numpy as np

import panelsim as ps

# What a spectrum amounts to.
spectrum = ps.Jonswap(4.0, 10.0)
periods = spectrum.mean_period, spectrum.zero_crossing_period  # s

# Sea state 6, and a hundred seas as they occur in the North Atlantic.
typical = ps.sea_state(6).spectrum()
heights, peak_periods = ps.north_atlantic().sample(100, seed=1)

# A short-crested sea from the north-east, for a ship that goes north.
sea = ps.RandomSeaway(
    typical,
    ps.JitteredFrequencies(0.3, 2.0, 0.05),
    np.deg2rad(225),  # from the starboard bow
    seed=1,
    spreading=ps.CosineSquared(),
    direction_step=np.deg2rad(15),
)

# The same sea for an observer at rest, and for the ship: after 60 s north at 8 m/s it turns to the east.
at_rest = sea.in_fixed_axes()
before = sea.in_translating_axes(8.0)
after = at_rest.in_translating_axes(8.0, np.deg2rad(90), time=60.0, position=(480.0, 0.0))
at_the_turn = before.elevation(0.0, 0.0, 60.0), after.elevation(0.0, 0.0, 60.0)
pressure = after.dynamic_pressure(0.0, 0.0, np.linspace(-20.0, -2.0, 5), 60.0, water_density=1025.0)

if __name__ == "__main__":
    print(f"JONSWAP: mean period {periods[0]:.2f} s, zero-crossing period {periods[1]:.2f} s")
    print(f"sea state 6: {typical.significant_wave_height:g} m, {typical.peak_period:g} s")
    print(f"of a hundred seas {np.sum(heights > 5.0)} are higher than 5 m")
    print(f"elevation at the turn {at_the_turn[0]:.6f} m before, {at_the_turn[1]:.6f} m after")
    print(f"wave pressure from 20 m to 2 m under water: {np.round(pressure / 1000, 2)} kPa")
