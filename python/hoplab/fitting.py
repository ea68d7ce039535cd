"""Fits of shared parameters to recorded hops."""

import copy
import time
from dataclasses import dataclass, field

import numpy as np

from . import _core
from ._inputs import dataset_source, problem_options, search_options, words


def _pair(interval):
    return None if interval is None else tuple(interval)


@dataclass(frozen=True)
class Parameter:
    """One fitted value, in its own SI unit; None where the data do not determine it.

    Attributes
    ----------
    name, unit : str
    value : float or None
    std_error : float or None
        Standard error from the stated noise.
    ci95 : tuple of float or None
        95 % interval from the stated noise, cut at the bounds.
    std_error_between_trials, ci95_between_trials
        The same from the scatter between trials: what counts where the model misses more than
        noise. None with fewer than 3 trials.
    initial : float
        Where the search began.
    at_bound : bool
        The value lies on a physical bound.
    """

    name: str
    unit: str
    value: float
    std_error: float
    ci95: tuple
    std_error_between_trials: float
    ci95_between_trials: tuple
    initial: float
    at_bound: bool

    @classmethod
    def _of(cls, entry):
        return cls(
            name=entry["name"],
            unit=entry["unit"],
            value=entry["value"],
            std_error=entry["std_error"],
            ci95=_pair(entry["ci95"]),
            std_error_between_trials=entry["std_error_between_trials"],
            ci95_between_trials=_pair(entry["ci95_between_trials"]),
            initial=entry["initial"],
            at_bound=entry["at_bound"],
        )


def parameters_of(entries):
    return {entry["name"]: Parameter._of(entry) for entry in entries}


@dataclass(frozen=True)
class TrialTrace:
    """One trial (or hop) as measured and as the fitted model has it.

    Attributes
    ----------
    file : str
    role : str
        ``"train"`` or ``"test"``.
    outcome : str
        How its simulation ended.
    rmse : dict of str to float
        Per channel, in its unit; None unless the simulation reached the last sample.
    start : dict of str to float
        Fitted start state.
    time_s : ndarray, shape (samples,)
    measured, simulated : dict of str to ndarray, shape (samples,)
        By channel; NaN where a sample is missing, or past the end of the simulation.
    """

    file: str
    role: str
    outcome: str
    rmse: dict
    start: dict
    time_s: np.ndarray
    measured: dict
    simulated: dict


@dataclass(frozen=True)
class Fit:
    """What `fit` found.

    Attributes
    ----------
    ok : bool
        There is a usable result; if not, `message` says why and values are None.
    message : str
    law : str
    parameters : dict of str to Parameter
    cost : float
        Half the sum of squared whitened residuals of the train trials, priors included.
    gradient : dict of str to float
        d `cost` / d parameter at the optimum, starts held.
    covariance, correlation : ndarray, shape (parameters, parameters), or None
        Of the parameters, own units, starts marginalised; NaN where undetermined.
    chi2_per_dof : float
        1 is expected where the model is right and the noise as stated.
    misfit : bool
        The model misses more than the noise: go by the intervals between trials.
    rmse : dict of str to dict
        ``rmse["test"]["body_y_m"]``: errors over the trials of a role, in the channel's unit.
    max_gradient_error : float
        Worst relative difference of the derivatives used from Richardson differences.
    traces : list of TrialTrace
    warnings, notes : list of str
    """

    ok: bool
    message: str
    law: str
    parameters: dict
    cost: float
    gradient: dict
    covariance: np.ndarray
    correlation: np.ndarray
    chi2_per_dof: float
    misfit: bool
    rmse: dict
    max_gradient_error: float
    traces: list = field(repr=False)
    warnings: list
    notes: list
    _record: dict = field(repr=False)

    def record(self):
        """The run.json of ``hoplab fit`` as a dict."""
        return copy.deepcopy(self._record)


def _traces(result):
    record = result["record"]
    out = []
    for trial, trace in zip(record["trials"], result["traces"]):
        out.append(
            TrialTrace(
                file=trial["file"],
                role=trial["role"],
                outcome=trial["outcome"],
                rmse=trial["rmse"],
                start=trial["start"],
                time_s=trace["time_s"],
                measured=trace["measured"],
                simulated=trace["simulated"],
            )
        )
    return out


def fit(
    dataset,
    *,
    law=None,
    free=(),
    fix=None,
    with_=(),
    keep_stray=False,
    starts=1,
    seed=1,
    strategy="apex_shooting",
    span="whole_else_hops",
    loss="squared",
    loss_scale=2.0,
    discrepancy="matern",
    profile=(),
    jobs=None,
    integrator="dop853",
    tolerance=1e-9,
):
    """Fit parameters to recorded hops, with intervals and a check of the derivatives used.

    Parameters
    ----------
    dataset : path or mapping
        A folder of the format hoplab-dataset/1, or a mapping laid out like its dataset.yaml in
        which each trial has a ``trace`` instead of a ``file``: a mapping of ``"time_s"`` and the
        channels (``"body_x_m"``, ...) to arrays of one length, NaN where a sample is missing.
    law : str, optional
        How the leg carries its load; default: the mechanism's.
    free : sequence of str, optional
        Parameters to fit, as ``["E", "d"]``; default: the mechanism's first two.
    fix : mapping of str to float, optional
        Parameters to hold, with their values in SI units.
    with_ : sequence of str, optional
        Effects whose parameters are fitted, too.
    keep_stray : bool, optional
        Whether samples that lie off the motion before and after them are compared like the others.
    starts : int, optional
        Searches: one from the nominal values, then scattered ones.
    seed : int, optional
        Of the scattered starts.
    strategy : {"apex_shooting", "growing_horizon", "raw"}, optional
        How a search gets into the basin of the optimum.
    span : {"whole_else_hops", "whole", "hops"}, optional
        Whole traces or single hops.
    loss : {"squared", "pseudo_huber"}, optional
    loss_scale : float, optional
        Standard deviations from which pseudo_huber is linear.
    discrepancy : {"matern", "none"}, optional
        Whether a smooth error of the model, where one pays, counts as noise beside the sensors'.
    profile : sequence of str, optional
        Parameters whose profile likelihood is computed, or ``"all"``; see `Fit.record`.
    jobs : int, optional
        Threads; default: all cores. Never changes a result.
    integrator : {"dop853", "erkstep", "cvodes"}, optional
    tolerance : float, optional
        Relative tolerance of a step.

    Returns
    -------
    Fit

    Raises
    ------
    InputError
        For a bad dataset or argument. A search that leads nowhere is a `Fit` that is not `ok`.
    KeyboardInterrupt
        On Ctrl-C, once the iteration under way is over.
    """
    began = time.perf_counter()
    options = problem_options(law, free, fix, with_, keep_stray, integrator, tolerance)
    options |= search_options(starts, seed, strategy, span, loss, loss_scale, discrepancy, jobs)
    options["profile"] = words(profile)
    result = _core.fit(dataset_source(dataset), options)
    record = result["record"]
    record["seconds"] = time.perf_counter() - began
    return Fit(
        ok=record["status"] == "ok",
        message=record["message"],
        law=record["law"],
        parameters=parameters_of(record["parameters"]),
        cost=record["cost"],
        gradient=record["objective"]["at_optimum"]["gradient"],
        covariance=result["covariance"],
        correlation=result["correlation"],
        chi2_per_dof=record["chi2_per_dof"],
        misfit=record["misfit"],
        rmse={role: record[role]["rmse"] for role in ("train", "test")},
        max_gradient_error=record["gradient_check"]["max_relative_error"],
        traces=_traces(result),
        warnings=record["warnings"],
        notes=record["notes"],
        _record=record,
    )
