"""Fits the same hops with several models and prints them as a table.

    python3 fit_table.py datasets/rig-drops
"""

import sys

import hoplab

dataset = sys.argv[1]
# What is varied: the law of the leg, and effects that the plain model lacks.
models = {
    "elastica": {},
    "consistent": {"law": "consistent"},
    "elastica with viscous material": {"with_": ["leg_material_damping"], "fix": {"d": 0}},
}

print(f"{'model':32} {'E [GPa]':>8} {'95 % between trials':>20} {'test error y [mm]':>18}")
for name, options in models.items():
    fit = hoplab.fit(dataset, **options)
    if not fit.ok:  # says why, and has no values
        print(f"{name:32} {fit.message}")
        continue
    e = fit.parameters["E"]
    low, high = e.ci95_between_trials
    interval = f"{low / 1e9:.2f} .. {high / 1e9:.2f}"
    error = 1000 * fit.rmse["test"]["body_y_m"]  # of the trials that were not fitted
    print(f"{name:32} {e.value / 1e9:8.2f} {interval:>20} {error:18.2f}")
