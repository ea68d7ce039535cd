"""Sweeps Young's modulus over a scenario: stance time and height of the next apex, as arrays.

    python3 sweep_modulus.py experiments/three-drops.yaml
"""

import sys

import hoplab
import numpy as np

scenario = sys.argv[1]


def first_hop(modulus):
    """Length of the first stance [s] and height of the apex after it [m]."""
    run = hoplab.simulate(
        scenario, parameters={"E": modulus}, set={"stop.hops": 1}, sensitivities=False
    )
    if not run.complete:  # it fell: an outcome with a name, not an exception
        return np.nan, np.nan
    time = {event["kind"]: event["time_s"] for event in run.events}
    return time["liftoff"] - time["touchdown"], run.final_state[1]


moduli = np.linspace(10e9, 40e9, 7)
stance, apex = np.array([first_hop(e) for e in moduli]).T
for row in zip(moduli / 1e9, 1000 * stance, apex):
    print("E %4.0f GPa  stance %5.1f ms  apex %.4f m" % row)

# A spring's stance is about half a period, which goes with E^-1/2.
slope = np.polyfit(np.log(moduli), np.log(stance), 1)[0]
print(f"stance goes with E^{slope:.2f}")
