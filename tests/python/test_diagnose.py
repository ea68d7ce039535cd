import unittest

import hoplab
from support import RIG_DROPS, run_program

OPTIONS = {"effects": ["leg_material_damping", "air_drag"], "max_effects": 1}


class Diagnose(unittest.TestCase):
    def test_equals_the_run_json_of_the_program(self):
        diagnosis = hoplab.diagnose(RIG_DROPS, **OPTIONS)
        theirs = run_program(
            "diagnose", RIG_DROPS, "--effects", "leg_material_damping,air_drag", "--max-effects", 1
        )
        mine = diagnosis.record()
        for record in (mine, theirs):
            self.assertGreater(record.pop("seconds"), 0.0)
        self.assertEqual(mine, theirs)
        self.assertEqual(diagnosis.verdict, theirs["verdict"])
        self.assertEqual(diagnosis.effects, ["leg_material_damping"])
        self.assertEqual(
            {c.effect: c.status for c in diagnosis.candidates},
            {c["effect"]: c["status"] for c in theirs["candidates"]},
        )
        self.assertGreater(diagnosis.extended_parameters["leg_material_damping.tau"].value, 0.0)

    def test_bad_input_names_the_argument(self):
        for kwargs, place in (
            ({"effects": ["storm"]}, "effects"),
            ({"without": ["storm"]}, "without"),
            ({"max_effects": 0}, "max_effects"),
        ):
            with self.subTest(kwargs=kwargs), self.assertRaises(hoplab.InputError) as caught:
                hoplab.diagnose(RIG_DROPS, **kwargs)
            self.assertEqual(caught.exception.place, place)


if __name__ == "__main__":
    unittest.main()
