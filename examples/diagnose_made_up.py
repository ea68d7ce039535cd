"""Makes hops with a cause that the model lacks, and lets hoplab find the cause.

    python3 diagnose_made_up.py experiments/three-drops.yaml
"""

import sys

import hoplab
import numpy as np

scenario = sys.argv[1]
truth = {"effects.air_drag.c_drag": 0.05}  # F = -c |v| v [N s^2/m^2]
noise = 0.0005  # standard deviation [m]
random = np.random.default_rng(7)
times = np.arange(0.0, 1.0, 0.004)

trials = []
for i, (angle, speed) in enumerate([(22, 1.3), (25, 1.4), (28, 1.6), (24, 1.5), (26, 1.4)]):
    start = {"x_m": 0.0, "y_m": 0.30, "vx_m_per_s": speed, "vy_m_per_s": 0.0}
    change = {"touchdown_angle_deg": angle, "stop.hops": None, **truth}
    run = hoplab.simulate(
        scenario, set=change, start=list(start.values()), times=times, sensitivities=False
    )
    trace = {"time_s": times}
    for channel in ("body_x_m", "body_y_m"):
        trace[channel] = run.channels[channel] + noise * random.normal(size=times.size)
    role = "train" if i < 3 else "test"
    trials.append({"role": role, "touchdown_angle_deg": angle, "initial": start, "trace": trace})

# What we believe of the leg: modulus and damping are off, and there is no word of drag.
leg = {"rest_radius_m": 0.09, "E_Pa": 20e9, "G_Pa": 4e9, "width_m": 0.03, "thickness_m": 0.0038}
leg["damping_N_s_per_m"] = 1.0
dataset = {
    "format": "hoplab-dataset/1",
    "name": "made-up",
    "mechanism": {"type": "c_leg", "body_mass_kg": 1.0, "gravity_m_per_s2": 9.81, "leg": leg},
    "channels": {"body_x_m": {"sigma": noise}, "body_y_m": {"sigma": noise}},
    "trials": trials,
}

# Four suspects only, to be quick; without `effects` the whole catalogue is tried.
suspects = ["air_drag", "guide_viscous_friction", "leg_mass", "ground_compliance"]
found = hoplab.diagnose(dataset, effects=suspects)
print(found.sentence)
size = found.extended_parameters[f"{found.cause}.c_drag"]
low, high = size.ci95
print(f"c_drag = {size.value:.3f}, 95 % interval {low:.3f} .. {high:.3f}; put in: 0.05")
