import signal
import threading
import unittest

import hoplab
import numpy as np
from support import RIG_DROPS, rig_drops_in_memory, run_program


class Fit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.fit = hoplab.fit(RIG_DROPS)
        cls.record = run_program("fit", RIG_DROPS)

    def test_equals_the_run_json_of_the_program(self):
        mine, theirs = self.fit.record(), dict(self.record)
        self.assertGreater(mine.pop("seconds"), 0.0)
        theirs.pop("seconds")
        self.assertEqual(mine, theirs)

    def test_gradient_equals_that_of_run_json(self):
        gradient = self.record["objective"]["at_optimum"]["gradient"]
        self.assertEqual(self.fit.gradient, gradient)
        self.assertEqual(set(gradient), {"E", "d"})

    def test_attributes_are_those_of_the_record(self):
        e = self.fit.parameters["E"]
        entry = self.record["parameters"][0]
        self.assertTrue(self.fit.ok)
        self.assertEqual((e.name, e.unit, e.value), (entry["name"], entry["unit"], entry["value"]))
        self.assertEqual(list(e.ci95), entry["ci95"])
        self.assertEqual(self.fit.covariance.shape, (2, 2))
        self.assertAlmostEqual(self.fit.covariance[0, 0] ** 0.5 / e.std_error, 1.0, places=12)
        self.assertEqual(self.fit.rmse["test"], self.record["test"]["rmse"])

    def test_traces_hold_the_errors_told(self):
        traces = self.fit.traces
        self.assertEqual(len(traces), 9)
        for trace in traces:
            for channel, rmse in trace.rmse.items():
                residual = trace.simulated[channel] - trace.measured[channel]
                self.assertEqual(residual.shape, trace.time_s.shape)
                self.assertAlmostEqual(np.sqrt(np.nanmean(residual**2)) / rmse, 1.0, places=9)

    def test_arrays_in_memory_fit_as_the_files_do(self):
        fit = hoplab.fit(rig_drops_in_memory())
        for name, parameter in fit.parameters.items():
            self.assertEqual(parameter.value, self.fit.parameters[name].value)
        self.assertEqual(fit.cost, self.fit.cost)

    def test_letters_beyond_the_basic_plane_stay_as_they_are(self):
        dataset = rig_drops_in_memory()
        dataset["title"] = "Drops \N{KANGAROO} of \u00e9lan"
        dataset["trials"][0]["file"] = "\N{KANGAROO}.csv"
        fit = hoplab.fit(dataset)
        self.assertEqual(fit.record()["trials"][0]["file"], "\N{KANGAROO}.csv")
        self.assertEqual(fit.traces[0].file, "\N{KANGAROO}.csv")
        self.assertEqual(fit.cost, self.fit.cost)


        kwargs = {"with_": ["leg_material_damping"], "fix": {"d": 0}}
        one = hoplab.fit(RIG_DROPS, jobs=1, **kwargs)
        two = hoplab.fit(RIG_DROPS, jobs=2, **kwargs)
        self.assertEqual(list(one.parameters), ["E", "leg_material_damping.tau"])
        self.assertEqual(one.cost, two.cost)
        without = hoplab.fit(RIG_DROPS, discrepancy="none")
        better = hoplab.fit(RIG_DROPS, discrepancy="none", **kwargs)
        self.assertLess(better.cost, without.cost)

    def test_a_stray_sample_is_set_aside_unless_asked_for(self):
        dataset = rig_drops_in_memory()
        trace = dataset["trials"][0]["trace"]
        trace["body_y_m"] = np.array(trace["body_y_m"], dtype=float)
        trace["body_y_m"][100] += 0.1
        fit = hoplab.fit(dataset)
        (fault,) = fit.record()["trace_faults"]
        self.assertEqual(fault["kind"], "stray")
        self.assertEqual(fault["channel"], "body_y_m")
        self.assertEqual(fault["times_s"], [trace["time_s"][100]])
        self.assertFalse(fault["compared"])
        kept = hoplab.fit(dataset, keep_stray=True)
        self.assertTrue(kept.record()["trace_faults"][0]["compared"])
        self.assertGreater(kept.cost, fit.cost + 0.5 * (0.09 / 0.0005) ** 2)

    def test_bad_input_names_the_argument(self):
        for kwargs, place in (
            ({"law": "rubber"}, "law"),
            ({"free": ["Q"]}, "free"),
            ({"fix": {"Q": 1.0}}, "fix"),
            ({"with_": ["storm"]}, "with_"),
            ({"strategy": "luck"}, "strategy"),
            ({"starts": 0}, "starts"),
            ({"starts": 2**40}, "starts"),
            ({"seed": -1}, "seed"),
            ({"seed": 2**64}, "seed"),
            ({"jobs": 0}, "jobs"),
            ({"jobs": -2}, "jobs"),
            ({"loss_scale": float("inf")}, "loss_scale"),
            ({"profile": ["m"]}, "profile"),
        ):
            with self.subTest(kwargs=kwargs), self.assertRaises(hoplab.InputError) as caught:
                hoplab.fit(RIG_DROPS, **kwargs)
            self.assertEqual(caught.exception.place, place)
        with self.assertRaises(hoplab.InputError) as caught:
            hoplab.fit("no/such/folder")
        self.assertIn("no/such/folder", caught.exception.place)

    def test_bad_arrays_are_told(self):
        data = rig_drops_in_memory()
        data["trials"][0]["trace"]["body_x_m"] = data["trials"][0]["trace"]["body_x_m"][:-1]
        with self.assertRaises(hoplab.InputError) as caught:
            hoplab.fit(data)
        self.assertIn("body_x_m", caught.exception.value)
        for kwargs in ({"starts": "many"}, {"law": 5}, {"free": [1]}):
            with self.subTest(kwargs=kwargs), self.assertRaises(TypeError):
                hoplab.fit(RIG_DROPS, **kwargs)

    def test_control_c_ends_a_long_fit(self):
        timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            hoplab.fit(RIG_DROPS, starts=100000)
        timer.join()


if __name__ == "__main__":
    unittest.main()
