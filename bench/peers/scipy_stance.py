#!/usr/bin/env python3
"""One stance by scipy's solve_ivp (DOP853, events), written the way one writes it in Python.

usage: scipy_stance.py PROBLEM.json REPETITIONS

PROBLEM.json: law ("large_deflection" or "straight_leg"), state (x, y [m], vx, vy [m/s] at
touch-down), parameters (SI), relative_tolerance, absolute_tolerance.
Prints JSON: liftoff_time_s, rhs_calls, seconds (one entry a repetition), version.

The law is written out again here from the equation sheet (model/README.md: M2, M2b, M9b-M14), in
scalar math without numpy, which is slow on vectors of five.
"""

import json
import math
import sys
import time

import numpy
import scipy
from scipy.integrate import solve_ivp

LONGEST_STANCE_S = 1.0


def compliance(phi, p):
    """C, C2 [m/N, m/N^2] with their first two derivatives in phi (M2, M2b, closed forms: phi > 1)."""
    sin, cos = math.sin(phi), math.cos(phi)
    h = 0.5 * phi
    s, k = math.sin(h), math.cos(h)
    ei, ea, ga, r = p["E"] * p["I"], p["E"] * p["A"], p["G"] * p["A"], p["r"]
    bending, axial, shear = 0.5 * r**3 / ei, 0.5 * r / ea, 0.5 * p["kappa"] * r / ga
    c = (bending * (2 * phi - 3 * sin + phi * cos) + axial * (3 * sin - phi)
         + shear * (phi - sin))
    c1 = bending * (2 - 2 * cos - phi * sin) + axial * (3 * cos - 1) + shear * (1 - cos)
    c_2 = bending * (sin - phi * cos) - 3 * axial * sin + shear * sin
    second = r**5 / ei**2
    g = 3 * h * h * s * k * k + 9 * h * k**3 - 1.5 * h * k - 8.5 * s * k * k + s
    g1 = 0.5 * (h * h * k * (3 * k * k - 6 * s * s) - 21 * h * s * k * k + 1.5 * h * s
                + 16.5 * s * s * k)
    return c, c1, c_2, second * g, second * g1


class ArcLeg:
    """Law `large_deflection` in rolling stance: F and phi from M9b and M10b by Newton."""

    def __init__(self, p, state):
        self.p = p
        self.phi = math.pi - p["theta_td"]
        x, _, _, _ = state
        self.start = list(state) + [x + p["r"] * math.sin(p["theta_td"]) - p["r"] * self.phi]

    def chord(self, z):
        """Chord force [N], contact lead [m] and chord length [m]."""
        x, y, vx, vy, x0 = z
        p, r, phi = self.p, self.p["r"], self.phi
        for _ in range(30):
            h = 0.5 * phi
            s, k = math.sin(h), math.cos(h)
            u = x0 + r * phi - x
            l = math.sqrt(u * u + y * y)
            c, c1, c_2, c2, c21 = compliance(phi, p)
            delta = 2 * r * s - l
            root = math.sqrt(c * c + 4 * c2 * delta)
            force = 2 * delta / (c + root)
            residual = u / l - k + force * (0.5 * c1 + force * c21 / 3) / r
            force_phi = (r * (k - u / l) - force * c1 - force * force * c21) / root
            # Without C2'' F^2/3: a little slower than Newton, the same root.
            slope = (r * y * y / l**3 + 0.5 * s + (0.5 * c1 + 2 / 3 * force * c21) * force_phi / r
                     + 0.5 * force * c_2 / r)
            step = -residual / slope
            phi += step
            if abs(step) < 1e-10:
                break
        self.phi = phi
        u = x0 + r * phi - x
        l = math.sqrt(u * u + y * y)
        c, _, _, c2, _ = compliance(phi, p)
        delta = 2 * r * math.sin(0.5 * phi) - l
        force = 2 * delta / (c + math.sqrt(c * c + 4 * c2 * delta))
        return force - p["d"] * (y * vy - u * vx) / l, u, l


class StraightLeg:
    """A linear spring and damper between the hip and a fixed toe."""

    def __init__(self, p, state):
        self.p = p
        self.start = list(state) + [state[0] + p["l0"] * math.sin(p["theta_td"])]

    def chord(self, z):
        x, y, vx, vy, toe = z
        u = toe - x
        l = math.sqrt(u * u + y * y)
        return self.p["k"] * (self.p["l0"] - l) - self.p["d"] * (y * vy - u * vx) / l, u, l


def stance(problem):
    """Lift-off time [s] and the number of right-hand sides."""
    p = problem["parameters"]
    leg = (ArcLeg if problem["law"] == "large_deflection" else StraightLeg)(p, problem["state"])
    m, g = p["m"], p["g"]

    def derivative(_, z):
        z = z.tolist()
        force, u, l = leg.chord(z)
        return [z[2], z[3], -force * u / (l * m), force * z[1] / (l * m) - g, 0.0]

    def liftoff(_, z):
        return leg.chord(z.tolist())[0]

    liftoff.terminal = True
    liftoff.direction = -1
    run = solve_ivp(derivative, (0.0, LONGEST_STANCE_S), numpy.array(leg.start), method="DOP853",
                    rtol=problem["relative_tolerance"], atol=problem["absolute_tolerance"],
                    events=liftoff)
    return run.t_events[0][0], run.nfev


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        problem = json.load(file)
    time_s, calls = stance(problem)  # also warms up
    seconds = []
    for _ in range(int(sys.argv[2])):
        begin = time.perf_counter()
        stance(problem)
        seconds.append(time.perf_counter() - begin)
    print(json.dumps({"liftoff_time_s": time_s, "rhs_calls": calls, "seconds": seconds,
                      "version": scipy.__version__}))


main()
