"""A fit's objective, for optimisers and samplers of one's own."""

from dataclasses import dataclass, field

import numpy as np

from . import _core
from ._inputs import dataset_source, jobs_of, problem_options


@dataclass(frozen=True)
class Evaluation:
    """The objective at one point. Columns are the parameters, then x, y, vx, vy of each trial's
    start, all in their own units.

    Attributes
    ----------
    complete : bool
        Every trial was simulated to the end of its data. If not, `cost` is NaN and arrays are None.
    outcomes : list of str
        How each trial's simulation ended.
    cost : float
        Half the sum of squared residuals: the negative log-likelihood up to a constant.
    residuals : ndarray, shape (residuals,), or None
        (simulated - measured)/sigma, trial by trial, then that trial's prior on its start.
    jacobian : ndarray, shape (residuals, columns), or None
        Exact derivatives of the residuals.
    gradient : ndarray, shape (columns,), or None
        Exact derivative of `cost`.
    """

    complete: bool
    outcomes: list
    cost: float
    residuals: np.ndarray = field(repr=False)
    jacobian: np.ndarray = field(repr=False)
    gradient: np.ndarray


class Problem:
    """The train trials of a dataset as a nonlinear least-squares problem.

    Parameters
    ----------
    dataset, law, free, fix, with_, keep_stray, jobs, integrator, tolerance
        As in `hoplab.fit`.

    Attributes
    ----------
    names, units : list of str
        Of the parameters.
    initial, lower, upper, scale : ndarray, shape (parameters,)
        Where a search begins, physical bounds, a typical size of each; own units.
    starts : ndarray, shape (trials, 4)
        Where each trial's start begins: x, y [m], vx, vy [m/s].
    files : list of str
        The trials.

    Examples
    --------
    >>> problem = hoplab.Problem("datasets/rig-drops")
    >>> at = problem.evaluate([22e9, 2.0])
    >>> at.cost, at.gradient[:2]
    """

    def __init__(
        self,
        dataset,
        *,
        law=None,
        free=(),
        fix=None,
        with_=(),
        keep_stray=False,
        jobs=None,
        integrator="dop853",
        tolerance=1e-9,
    ):
        options = problem_options(law, free, fix, with_, keep_stray, integrator, tolerance)
        self._problem = _core.TrainProblem(
            dataset_source(dataset), options | {"jobs": jobs_of(jobs)}
        )
        rows = self._problem.parameters
        self.names = [row[0] for row in rows]
        self.units = [row[1] for row in rows]
        table = np.array([row[2:] for row in rows], dtype=float)
        self.initial, self.lower, self.upper, self.scale = table.T
        self.starts = self._problem.starts
        self.files = self._problem.files

    def evaluate(self, values=None, starts=None):
        """The objective with its exact derivatives.

        Parameters
        ----------
        values : array_like, shape (parameters,), optional
            Own units; default: `initial`.
        starts : array_like, shape (trials, 4), optional
            Default: `starts`.

        Returns
        -------
        Evaluation
        """
        values = self.initial if values is None else np.asarray(values, dtype=float)
        starts = self.starts if starts is None else np.asarray(starts, dtype=float)
        return Evaluation(**self._problem.evaluate(values, starts))
