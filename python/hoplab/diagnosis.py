"""What the simulation lacks, as far as the data show it."""

import copy
import time
from dataclasses import dataclass, field
from operator import index

from . import _core
from ._inputs import dataset_source, problem_options, search_options, words
from .fitting import parameters_of


@dataclass(frozen=True)
class Candidate:
    """One effect of the catalogue and what the data say of it.

    Attributes
    ----------
    effect : str
    status : str
        Whether the data support it, exclude it, or could not have shown it.
    p_value : float or None
        Of its score test at the fit without it.
    gain_nats : float or None
        Log-likelihood gained by adding it alone.
    expected_size : dict of str to float
        Per parameter of the effect, from the score test.
    bound95 : dict of str to float
        The size the data exclude, where they exclude it.
    separable : bool
        The data can tell it from the fitted values.
    """

    effect: str
    status: str
    p_value: float
    gain_nats: float
    expected_size: dict
    bound95: dict
    separable: bool


@dataclass(frozen=True)
class Diagnosis:
    """What `diagnose` found.

    Attributes
    ----------
    ok : bool
        There is a verdict; if not, `message` says why.
    message : str
    verdict : {"adequate", "named", "confounded", "unexplained"} or None
    sentence : str or None
        The verdict in words.
    cause : str or None
        The effect that explains most, where one is named.
    group : list of str
        What cannot be told from the cause, itself first.
    effects : list of str
        The effects of the best extension.
    candidates : list of Candidate
        The whole catalogue as far as it applies.
    p_value : float or None
        Chance of as extreme a misfit under noise alone.
    parameters : dict of str to Parameter
        Fitted values of the model as it was.
    extended_parameters : dict of str to Parameter, or None
        Those of the extended model, sizes of the effects included.
    held_out_gain : dict or None
        Nats a sample gained on trials not fitted, with its 95 % interval.
    separating_experiment : dict or None
        The trial to record next, where several causes remain.
    """

    ok: bool
    message: str
    verdict: str
    sentence: str
    cause: str
    group: list
    effects: list
    candidates: list = field(repr=False)
    p_value: float
    parameters: dict
    extended_parameters: dict
    held_out_gain: dict
    separating_experiment: dict
    _record: dict = field(repr=False)

    def record(self):
        """The run.json of ``hoplab diagnose`` as a dict."""
        return copy.deepcopy(self._record)


def _candidate(entry):
    return Candidate(**{name: entry[name] for name in Candidate.__dataclass_fields__})


def diagnose(
    dataset,
    *,
    law=None,
    free=(),
    fix=None,
    with_=(),
    keep_stray=False,
    effects=(),
    without=(),
    max_effects=5,
    starts=1,
    seed=1,
    span="whole_else_hops",
    discrepancy="matern",
    jobs=None,
    integrator="dop853",
    tolerance=1e-7,
):
    """Name what the simulation lacks, extend it and measure what that brings.

    Parameters
    ----------
    dataset, law, free, fix, with_, keep_stray, span, discrepancy, jobs, integrator
        As in `fit`.
    tolerance : float, optional
        Relative tolerance of a step: hundreds of models are tried.
    effects : sequence of str, optional
        Effects to try; default: all that apply.
    without : sequence of str, optional
        Effects not to try.
    max_effects : int, optional
        Most effects to add to the model, 1 to 10.
    starts : int, optional
        Searches for the model as it is.
    seed : int, optional
        Of scattered starts, noise draws and bootstraps.

    Returns
    -------
    Diagnosis

    Raises
    ------
    InputError
        For a bad dataset or argument. Data that allow no diagnosis give one that is not `ok`.
    KeyboardInterrupt
        On Ctrl-C, once the step under way is over.
    """
    began = time.perf_counter()
    options = problem_options(law, free, fix, with_, keep_stray, integrator, tolerance)
    options |= search_options(starts, seed, "apex_shooting", span, "squared", 2.0, discrepancy, jobs)
    options |= {"effects": words(effects), "without": words(without)}
    options["max_effects"] = index(max_effects)
    record = _core.diagnose(dataset_source(dataset), options)
    record["seconds"] = time.perf_counter() - began
    extension = record["extension"]
    return Diagnosis(
        ok=record["status"] == "ok",
        message=record["message"],
        verdict=record["verdict"],
        sentence=record["sentence"],
        cause=record["cause"],
        group=record["group"],
        effects=record["effects"],
        candidates=[_candidate(entry) for entry in record["candidates"]],
        p_value=record["detection"]["p_value"],
        parameters=parameters_of(record["null"]["parameters"]),
        extended_parameters=parameters_of(extension["parameters"]) if extension else None,
        held_out_gain=extension["heldout_gain"] if extension else None,
        separating_experiment=record["separating_experiment"],
        _record=record,
    )
