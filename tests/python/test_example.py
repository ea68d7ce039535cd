import pathlib
import re
import subprocess
import sys
import unittest

from support import RIG_DROPS, ROOT, run_program


class Example(unittest.TestCase):
    def test_runs_word_for_word_and_prints_what_the_program_finds(self):
        example = ROOT / "examples" / "fit_rig_drops.py"
        done = subprocess.run(
            [sys.executable, "-B", example, RIG_DROPS], capture_output=True, text=True, check=True
        )
        record = run_program("fit", RIG_DROPS)
        e = record["parameters"][0]
        low, high = e["ci95_between_trials"]
        lines = done.stdout.splitlines()
        self.assertEqual(
            lines[0],
            f"E = {e['value'] / 1e9:.2f} GPa, between trials {low / 1e9:.2f} .. {high / 1e9:.2f}",
        )
        self.assertTrue(any(line.startswith("test-") for line in lines))
        self.assertIn("leg_material_damping", lines[-2])
        self.assertIn("leg_mass", lines[-2])
        before, after = map(float, re.search(r"([\d.]+) -> ([\d.]+) mm", lines[-1]).groups())
        self.assertEqual(before, round(1000 * record["test"]["rmse"]["body_y_m"], 2))
        self.assertLess(after, before / 3)

    def test_the_page_on_installation_shows_what_runs(self):
        page = (pathlib.Path(ROOT) / "docs" / "install.md").read_text()
        block = re.search(r"```python\n(.*?)```", page, re.S)[1]
        done = subprocess.run(
            [sys.executable, "-B", "-c", block], cwd=ROOT, capture_output=True, text=True, check=True
        )
        self.assertIn("E ", done.stdout)


if __name__ == "__main__":
    unittest.main()
