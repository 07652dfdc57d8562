"""The bits of runs and of strip coefficients do not depend on how many threads the linear algebra has."""

import os
import subprocess
import sys

# A transom makes the linear system of a run larger than what one thread does alone.
PROGRAM = """
import hashlib
from types import SimpleNamespace
import numpy as np
import panelsim as ps
from panelsim.hydro.strip.assembly import Strips
from panelsim.hydro.transom import Transom
from panelsim.loads.load import times_each
from panelsim.motion.exact import advance, harmonic_inputs, polynomial_inputs

def tell(*arrays):
    print(hashlib.sha256(b"".join(np.ascontiguousarray(a).tobytes() for a in arrays)).hexdigest())

ship = ps.load_ship("halifax", 6.0)
database = ps.database_for(ship)
transom = Transom.of_ship(ship, database.frequencies)
sea = ps.RandomSeaway(ps.Bretschneider(7.5, 9.9), ps.EvenFrequencies(0.2, 2.0, 0.1), 2.6, seed=1)
history = ps.simulate(
    ship, sea, speed=10.0, duration=3.0, ramp=2.0, time_step=0.25, database=database, transom=transom,
    initial_displacement=(0, 0, 0.1, 0.1, 0.01, 0.01),
)
tell(history.displacement, *history.loads.values())

rng = np.random.default_rng(1)
for size in (90, 96, 102, 120, 150):
    matrix, start = rng.normal(size=(size, size)), rng.normal(size=(1, size))
    tell(
        times_each(matrix, start),
        advance(matrix, 0.3),
        polynomial_inputs(matrix, np.eye(size, 6), 0.3, (0, -1, -2)),
        harmonic_inputs(matrix, np.eye(size, 40) + 1j, 0.3, np.linspace(0.1, 4.0, 40)),
    )
inertia = rng.normal(size=(71, 21, 3, 3)) + 1j * rng.normal(size=(71, 21, 3, 3))
sections = SimpleNamespace(strip_length=rng.uniform(1.0, 9.0, 21))
strips = SimpleNamespace(middle=rng.normal(size=21), sections=sections, section_inertia=inertia)
tell(Strips.inertia.func(strips))
"""


def test_runs_and_strip_coefficients_have_the_same_bits_on_any_number_of_threads() -> None:
    """In processes of their own: the linear algebra asks for the number when it is loaded."""
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", PROGRAM],
            env=os.environ | {"OPENBLAS_NUM_THREADS": str(threads), "OMP_NUM_THREADS": str(threads)},
            stdout=subprocess.PIPE,
            text=True,
        )
        for threads in (1, 2)
    ]
    told = [process.communicate()[0].splitlines()[-7:] for process in processes]
    assert len(told[0]) == len(set(told[0])) == 7
    assert told[0] == told[1]
