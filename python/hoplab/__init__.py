"""Hoppers with compliant legs: simulate with exact sensitivities, fit to recorded hops, diagnose.

The same services as the program ``hoplab``, with NumPy arrays in and out. Everything is in SI units
and radians; x points forward, y up, and states are those of the hip. What was not computed is None,
or NaN in an array, never 0.

    >>> import hoplab
    >>> fit = hoplab.fit("datasets/rig-drops")
    >>> print(fit.parameters["E"].value)

Functions: `simulate`, `fit`, `diagnose`; `Problem` is a fit's objective with its Jacobian, for other
optimisers and samplers; `InputError` says what is wrong with an input.
"""

from ._core import InputError, __version__
from .diagnosis import Candidate, Diagnosis, diagnose
from .fitting import Fit, Parameter, TrialTrace, fit
from .problem import Evaluation, Problem
from .simulation import Simulation, simulate

__all__ = [
    "Candidate",
    "Diagnosis",
    "Evaluation",
    "Fit",
    "InputError",
    "Parameter",
    "Problem",
    "Simulation",
    "TrialTrace",
    "__version__",
    "diagnose",
    "fit",
    "simulate",
]
