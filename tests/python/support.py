"""What the tests share: the shipped data, and the program the module is compared with."""

import json
import os
import pathlib
import re
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
RIG_DROPS = ROOT / "datasets" / "rig-drops"

# A half-circular leg dropped forward; touches down and lifts off twice within a second.
SCENARIO = {
    "format": "hoplab-scenario/1",
    "name": "two-hops",
    "law": "large_deflection",
    "mechanism": {
        "type": "c_leg",
        "body_mass_kg": 1.0,
        "gravity_m_per_s2": 9.81,
        "leg": {
            "rest_radius_m": 0.09,
            "E_Pa": 22e9,
            "G_Pa": 4e9,
            "width_m": 0.03,
            "thickness_m": 0.0038,
            "damping_N_s_per_m": 3.0,
        },
    },
    "touchdown_angle_deg": 25,
    "initial": {"x_m": 0, "y_m": 0.3, "vx_m_per_s": 1.0, "vy_m_per_s": 0},
    "stop": {"time_s": 0.8},
}


def run_program(*arguments, scenario=None):
    """The record that ``hoplab ARGUMENTS --json`` prints."""
    with tempfile.TemporaryDirectory() as folder:
        if scenario is not None:
            (pathlib.Path(folder) / "scenario.yaml").write_text(json.dumps(scenario))
        done = subprocess.run(
            [os.environ["HOPLAB_BINARY"], *map(str, arguments), "--json"],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=True,
        )
    return json.loads(done.stdout)


def rig_drops_in_memory():
    """The shipped drops as a mapping with arrays: body_x_m and body_y_m of each trial."""
    text = (RIG_DROPS / "dataset.yaml").read_text()

    def block(keys):  # {x_m: 1, y_m: 2}
        return {key: float(value) for key, value in re.findall(r"(\w+): ([-\d.e]+)", keys)}

    trials = []
    pattern = (
        r"- file: (\S+)\n +role: (\w+)\n +touchdown_angle_deg: (\S+)\n"
        r" +initial: (.*)\n +initial_sigma: (.*)"
    )
    for file, role, angle, initial, sigma in re.findall(pattern, text):
        t, x, y = np.loadtxt(RIG_DROPS / file, delimiter=",", skiprows=1, usecols=(0, 1, 2)).T
        trials.append(
            {
                "role": role,
                "touchdown_angle_deg": float(angle),
                "initial": block(initial),
                "initial_sigma": block(sigma),
                "trace": {"time_s": t, "body_x_m": x, "body_y_m": y},
            }
        )
    leg = block(re.search(r"leg: (.*)", text)[1])
    return {
        "format": "hoplab-dataset/1",
        "name": "rig-drops",
        "mechanism": {
            "type": "c_leg",
            "body_mass_kg": np.float64(1.010),
            "gravity_m_per_s2": 9.81,
            "leg": leg,
        },
        "channels": {"body_x_m": {"sigma": 0.0005}, "body_y_m": {"sigma": 0.0005}},
        "trials": trials,
    }
