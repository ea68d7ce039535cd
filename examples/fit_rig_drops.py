"""Fits the shipped drops, asks what the simulation lacks, and looks at the residuals.

    python3 fit_rig_drops.py datasets/rig-drops
"""

import sys

import hoplab
import numpy as np

dataset = sys.argv[1]

fit = hoplab.fit(dataset)
e = fit.parameters["E"]
low, high = e.ci95_between_trials
print(f"E = {e.value / 1e9:.2f} GPa, between trials {low / 1e9:.2f} .. {high / 1e9:.2f}")
print(f"derivatives checked to {fit.max_gradient_error:.0e}")
for trace in fit.traces:
    if trace.role == "test":
        residual = trace.simulated["body_y_m"] - trace.measured["body_y_m"]
        print(f"{trace.file}: height off by up to {1000 * np.nanmax(np.abs(residual)):.1f} mm")

suspects = ["leg_material_damping", "leg_mass"]
diagnosis = hoplab.diagnose(dataset, effects=suspects, max_effects=2)
print(diagnosis.sentence)

extended = hoplab.fit(dataset, with_=diagnosis.effects, fix={"d": 0})
before, after = fit.rmse["test"]["body_y_m"], extended.rmse["test"]["body_y_m"]
print(f"height error on trials not fitted: {1000 * before:.2f} -> {1000 * after:.2f} mm")
