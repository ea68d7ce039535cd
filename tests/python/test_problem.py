import unittest

import hoplab
import numpy as np
from support import RIG_DROPS, run_program


class Problem(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.problem = hoplab.Problem(RIG_DROPS)

    def test_gradient_at_the_nominal_values_equals_that_of_run_json(self):
        theirs = run_program("fit", RIG_DROPS, "--discrepancy", "none")["objective"]["at_nominal"]
        at = self.problem.evaluate()
        self.assertTrue(at.complete)
        self.assertEqual(at.cost, theirs["cost"])
        self.assertEqual(dict(zip(self.problem.names, at.gradient)), theirs["gradient"])

    def test_gradient_equals_central_differences_of_the_cost(self):
        # Steps of 1e-5 of each column's size: truncation 1e-9, rounding of the cost 1e-8 of it.
        problem = hoplab.Problem(RIG_DROPS, tolerance=1e-12)
        values, starts = problem.initial, problem.starts
        at = problem.evaluate(values, starts)
        np.testing.assert_allclose(at.gradient, at.jacobian.T @ at.residuals, rtol=1e-12)
        sizes = np.concatenate([problem.scale, np.full(starts.size, 0.1)])

        def cost(point):
            return problem.evaluate(point[:2], point[2:].reshape(starts.shape)).cost

        point = np.concatenate([values, starts.ravel()])
        for column in [0, 1, 2, 3, 4, 5, starts.size + 1]:
            step = np.zeros_like(point)
            step[column] = 1e-5 * sizes[column]
            difference = (cost(point + step) - cost(point - step)) / (2 * step[column])
            self.assertLess(
                abs(difference - at.gradient[column]), 1e-5 * abs(at.gradient[column]), column
            )

    def test_gauss_newton_on_it_reaches_the_fit(self):
        # An optimiser of the user's own: the shared values and every start, 26 unknowns.
        problem = self.problem
        count = len(problem.names)
        point = np.concatenate([problem.initial, problem.starts.ravel()])
        for _ in range(12):
            at = problem.evaluate(point[:count], point[count:].reshape(-1, 4))
            scale = np.linalg.norm(at.jacobian, axis=0)
            step, *_ = np.linalg.lstsq(at.jacobian / scale, -at.residuals, rcond=None)
            point = point + step / scale
        fit = hoplab.fit(RIG_DROPS, discrepancy="none")
        self.assertLess(abs(point[0] / fit.parameters["E"].value - 1.0), 1e-6)
        self.assertLess(abs(at.cost / fit.cost - 1.0), 1e-9)

    def test_where_a_simulation_falls_nothing_is_made_up(self):
        at = self.problem.evaluate([1e8, 1.0])
        self.assertFalse(at.complete)
        self.assertTrue(np.isnan(at.cost))
        self.assertIsNone(at.gradient)
        self.assertIn("fell", " ".join(at.outcomes))

    def test_bad_values_are_told(self):
        for values in ([1.0], [-1.0, 1.0], [np.nan, 1.0]):
            with self.subTest(values=values), self.assertRaises(hoplab.InputError):
                self.problem.evaluate(values)
        with self.assertRaises(hoplab.InputError):
            self.problem.evaluate(starts=np.zeros((2, 4)))


if __name__ == "__main__":
    unittest.main()
