"""Simulation of a scenario with exact derivatives."""

import copy
import os
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from . import _core
from ._inputs import numbers, text_of, words

_STATE = ("x_m", "y_m", "vx_m_per_s", "vy_m_per_s")


@dataclass(frozen=True)
class Simulation:
    """A simulated run.

    Attributes
    ----------
    outcome : str
        How it ended: ``"completed"``, ``"hop_limit"``, or the name of what went wrong. A simulation
        that fails is an outcome, not an exception.
    outcome_sentence : str
        The same in words.
    end_time_s : float
        Where it ended [s].
    hops : int
        Apexes after a stance; bounces of a ball.
    time_s : ndarray, shape (samples,)
        Times of the samples [s].
    channels : dict of str to ndarray, shape (samples,)
        What sensors would see, by the names of the data format, unit included (``"body_x_m"``). NaN
        past the end of the run.
    parameter_names : tuple of str
        What the run was differentiated by; empty without sensitivities.
    sensitivities : ndarray, shape (samples, channels, parameters), or None
        d channel / d parameter at fixed time, channels in the order of `channels`, in the units of
        both.
    events : list of dict
        Located events with kind, time, modes and states before and after, as in run.json.
    event_time_sensitivities : ndarray, shape (events, parameters), or None
        d event time / d parameter.
    final_state : ndarray, shape (4,)
        x, y [m], vx, vy [m/s] at `end_time_s`.
    """

    outcome: str
    outcome_sentence: str
    end_time_s: float
    hops: int
    time_s: np.ndarray
    channels: dict
    parameter_names: tuple
    sensitivities: np.ndarray
    events: list
    event_time_sensitivities: np.ndarray
    final_state: np.ndarray
    _record: dict = field(repr=False)

    @property
    def complete(self):
        """Whether it speaks for the whole time asked for."""
        return self.outcome in ("completed", "hop_limit")

    def sensitivity(self, channel, parameter):
        """d `channel` / d `parameter` at each sample, shape (samples,)."""
        if self.sensitivities is None:
            raise ValueError("simulated without sensitivities")
        row = list(self.channels).index(channel)
        return self.sensitivities[:, row, self.parameter_names.index(parameter)]

    def record(self):
        """What run.json of ``hoplab simulate`` tells of the run, as a dict."""
        return copy.deepcopy(self._record)


def simulate(
    scenario,
    *,
    law=None,
    set=None,
    start=None,
    parameters=None,
    times=None,
    channels=None,
    sensitivities=True,
    integrator="dop853",
    tolerance=1e-9,
):
    """Simulate a scenario, with exact derivatives through every event.

    Parameters
    ----------
    scenario : path or mapping
        A file of the format hoplab-scenario/1, or a mapping laid out like one.
    law : str, optional
        How the leg carries its load, over the scenario's; ``hoplab laws`` lists them.
    set : mapping of str to value, optional
        Dotted keys of the scenario with what is put there, as
        ``{"controller.kp_N_s": 4, "effects.air_drag.c_drag": 0.05}``.
    start : array_like, shape (4,), optional
        x, y [m], vx, vy [m/s] of the hip in flight, over the scenario's ``initial``.
    parameters : mapping of str to float, optional
        Physical parameters by their short names (``{"E": 22e9}``) in SI units, over the scenario's.
    times : array_like, shape (samples,), optional
        When to sample [s], ascending; the last one ends the run. Default: every millisecond to the
        end of the scenario.
    channels : sequence of str, optional
        What to sample; default: all that the mechanism has.
    sensitivities : bool or sequence of str, optional
        What to differentiate by: True for every parameter, every acting effect's parameter
        (``"air_drag.c_drag"``) and the start (``"x0"``, ``"y0"``, ``"vx0"``, ``"vy0"``), False for
        nothing, or names.
    integrator : {"dop853", "erkstep", "cvodes"}, optional
        Solver of the continuous modes.
    tolerance : float, optional
        Relative tolerance of a step.

    Returns
    -------
    Simulation

    Raises
    ------
    InputError
        For a bad scenario or argument. A run that falls or cannot go on is a `Simulation` whose
        `outcome` says so.
    """
    in_memory = isinstance(scenario, Mapping)
    settings = [(key, text_of(value)) for key, value in dict(set or {}).items()]
    if law is not None:
        settings.append(("law", text_of(law)))
    if start is not None:
        state = np.asarray(start, dtype=float)
        if state.shape != (4,):
            raise ValueError(f"start must be of shape (4,), not {state.shape}")
        settings += [(f"initial.{n}", text_of(v)) for n, v in zip(_STATE, state)]
    if times is not None:
        times = np.atleast_1d(np.asarray(times, dtype=float))
        if times.ndim != 1 or times.size == 0 or not np.all(np.diff(times) >= 0):
            raise ValueError("times must be one ascending row of numbers")
        settings.append(("stop.time_s", text_of(times[-1])))
    if isinstance(sensitivities, bool):
        wanted = None if sensitivities else []
    else:
        wanted = words(sensitivities)
    result = _core.simulate(
        {
            "file": "" if in_memory else os.fspath(scenario),
            "text": text_of(dict(scenario)) if in_memory else "",
            "set": settings,
            "parameters": numbers(parameters),
            "times": times,
            "channels": None if channels is None else words(channels),
            "sensitivities": wanted,
            "integrator": integrator,
            "tolerance": float(tolerance),
        }
    )
    record = result["record"]
    state = [record["final_state"][name] for name in _STATE]
    return Simulation(
        outcome=record["outcome"],
        outcome_sentence=record["outcome_sentence"],
        end_time_s=record["end_time_s"],
        hops=record["hops"],
        time_s=result["time_s"],
        channels=dict(zip(result["channel_names"], result["samples"].T)),
        parameter_names=tuple(result["parameter_names"]),
        sensitivities=result["sensitivities"],
        events=record["events"],
        event_time_sensitivities=result["event_time_sensitivities"],
        final_state=np.array([np.nan if v is None else v for v in state]),
        _record=record,
    )
