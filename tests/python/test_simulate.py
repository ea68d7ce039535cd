import copy
import unittest

import hoplab
import numpy as np
from support import ROOT, SCENARIO, run_program


class Simulate(unittest.TestCase):
    def test_sensitivities_equal_those_in_run_json(self):
        names = ["E", "d", "x0", "vy0"]
        record = run_program(
            "simulate", "scenario.yaml", "--sensitivities", ",".join(names), scenario=SCENARIO
        )
        run = hoplab.simulate(SCENARIO, sensitivities=names)
        self.assertEqual(run.record()["sensitivities"], record["sensitivities"])
        self.assertEqual(run.record()["events"], record["events"])
        for column, name in enumerate(names):
            np.testing.assert_array_equal(
                run.event_time_sensitivities[:, column],
                record["sensitivities"][name]["event_times"],
            )

    def test_sensitivities_equal_central_differences_of_simulations(self):
        # Rows away from events: velocities and forces jump there. A step of 1e-5 of the value leaves
        # 1e-10 of truncation and, at a tolerance of 1e-12, 1e-7 of rounding.
        times = np.arange(0.0, 0.8, 0.01)
        steps = {"E": 22e9 * 1e-5, "d": 3.0 * 1e-5, "m": 1e-5, "g": 9.81e-5}
        channels = ["body_x_m", "body_y_m", "body_vx_m_per_s", "body_vy_m_per_s"]
        kwargs = {"times": times, "channels": channels, "tolerance": 1e-12}
        run = hoplab.simulate(SCENARIO, sensitivities=list(steps), **kwargs)
        self.assertTrue(run.complete, run.outcome_sentence)
        self.assertGreaterEqual(len(run.events), 4)
        smooth = np.all(
            np.abs(times[:, None] - [event["time_s"] for event in run.events]) > 2e-4, axis=1
        )
        self.assertGreater(np.count_nonzero(smooth), 70)
        values = {"E": 22e9, "d": 3.0, "m": 1.0, "g": 9.81}
        for name, step in steps.items():
            above, below = (
                hoplab.simulate(
                    SCENARIO,
                    parameters={name: values[name] + sign * step},
                    sensitivities=False,
                    **kwargs,
                )
                for sign in (1, -1)
            )
            for channel in channels:
                exact = run.sensitivity(channel, name)[smooth]
                difference = (above.channels[channel] - below.channels[channel])[smooth] / (2 * step)
                error = np.linalg.norm(exact - difference) / np.linalg.norm(exact)
                self.assertLess(error, 1e-6, f"{channel} by {name}")

    def test_starts_and_times_are_arrays_and_results_have_the_shapes_told(self):
        times = np.linspace(0.0, 0.5, 11)
        run = hoplab.simulate(
            SCENARIO, start=np.array([0.1, 0.4, 0.5, 0.0]), times=times, sensitivities=True
        )
        np.testing.assert_array_equal(run.time_s, times)
        self.assertEqual(run.end_time_s, 0.5)
        self.assertEqual(run.channels["body_x_m"].shape, (11,))
        self.assertEqual(run.channels["body_x_m"][0], 0.1)
        self.assertEqual(run.sensitivities.shape, (11, len(run.channels), len(run.parameter_names)))
        self.assertEqual(run.parameter_names[-4:], ("x0", "y0", "vx0", "vy0"))
        self.assertEqual(run.sensitivity("body_x_m", "x0")[-1], 1.0)  # shifts with the start
        self.assertIsNone(hoplab.simulate(SCENARIO, sensitivities=False).sensitivities)

    def test_effects_act_and_are_differentiated_by(self):
        drag = {"effects.air_drag.c_drag": 0.05}
        run = hoplab.simulate(SCENARIO, set=drag, sensitivities=["air_drag.c_drag"])
        plain = hoplab.simulate(SCENARIO, sensitivities=False)
        self.assertLess(run.channels["body_vx_m_per_s"][100], plain.channels["body_vx_m_per_s"][100])
        self.assertLess(run.sensitivity("body_x_m", "air_drag.c_drag")[100], 0.0)

    def test_a_file_gives_what_its_content_gives(self):
        file = ROOT / "experiments" / "three-drops.yaml"
        run = hoplab.simulate(file, sensitivities=["E"])
        record = run_program("simulate", file, "--sensitivities", "E")
        self.assertEqual(run.record()["final_state"], record["final_state"])

    def test_a_run_that_falls_is_an_outcome(self):
        run = hoplab.simulate(SCENARIO, parameters={"E": 1e8}, times=np.linspace(0, 1, 101))
        self.assertFalse(run.complete)
        self.assertTrue(run.outcome.startswith("fell"), run.outcome)
        self.assertTrue(np.isnan(run.channels["body_y_m"][-1]))
        self.assertTrue(np.isnan(run.sensitivities[-1]).all())

    def test_bad_input_is_told_with_its_parts(self):
        bad = copy.deepcopy(SCENARIO)
        bad["mechanism"]["leg"]["E_Pa"] = -4.0
        with self.assertRaises(hoplab.InputError) as caught:
            hoplab.simulate(bad)
        error = caught.exception
        self.assertIsInstance(error, ValueError)
        self.assertIn("E_Pa", error.value)
        self.assertIn("must be in", error.rule)
        self.assertTrue(error.place.startswith("scenario:"), error.place)
        self.assertIn(error.rule, str(error))
        for kwargs, place in (
            ({"parameters": {"F": 1.0}}, "parameters"),
            ({"parameters": {"k": 1.0}}, "parameters"),  # of another mechanism
            ({"parameters": {"E": -1.0}}, "parameters"),
            ({"channels": ["body_z_m"]}, "channels"),
            ({"sensitivities": ["Q"]}, "sensitivities"),
            ({"integrator": "euler"}, "integrator"),
            ({"set": {"mechanism.leg.E_Pa": "stiff"}}, "set mechanism.leg.E_Pa"),
        ):
            with self.subTest(kwargs=kwargs), self.assertRaises(hoplab.InputError) as caught:
                hoplab.simulate(SCENARIO, **kwargs)
            self.assertEqual(caught.exception.place, place)

    def test_help_tells_shapes_and_units(self):
        for function in (hoplab.simulate, hoplab.fit, hoplab.diagnose):
            self.assertIn("Parameters\n", function.__doc__)
            self.assertIn("Returns\n", function.__doc__)
        self.assertIn("shape (samples, channels, parameters)", hoplab.Simulation.__doc__)


if __name__ == "__main__":
    unittest.main()
