"""The benchmark's statistics, on data that are known: none of these tests asserts a time."""
import contextlib
import io
import itertools
import json
import pathlib
import tempfile
import unittest
from math import comb

import numpy as np

from metamer.bench import significance
from metamer.bench.cases import make_cases
from metamer.bench.command import main
from metamer import errors
from support import BIN, SCENE, local

TRIALS = 60
CASES = 6


def noise(draw: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """As times are: 1.5 % of their own, and one in ten disturbed by up to a half."""
    disturbed = draw.random(shape) < 0.1
    return np.exp(draw.normal(0, 0.015, shape)) * np.where(disturbed, 1 + 0.5 * draw.random(shape), 1)


def drift(draw: np.random.Generator, rounds: int) -> np.ndarray:
    """What the machine does in a round to all that runs in it: by a third in the end, slowly."""
    return np.exp(np.cumsum(draw.normal(0, 0.05, rounds)))


class Significance(unittest.TestCase):
    def alarms(self, test, rounds: int, slow_down: float, common: bool) -> tuple[int, int]:
        """In how many trials the first case, which is slower, is found, and in how many another one is."""
        draw = np.random.default_rng(7)
        found = false = 0
        for _ in range(TRIALS):
            chances = []
            for case in range(CASES):
                shared = drift(draw, rounds) if common else 1.0
                factor = 1 + slow_down if case == 0 else 1.0
                chances.append(test(factor * shared * noise(draw, (rounds,)), shared * noise(draw, (rounds,))))
            stands = significance.holm(chances)
            found += stands[0]
            false += any(stands[1:])
        return found, false

    def test_five_percent_are_found_against_a_record(self) -> None:
        found, false = self.alarms(significance.mann_whitney, 20, 0.05, common=False)
        self.assertGreaterEqual(found, 0.9 * TRIALS)
        self.assertLessEqual(false, 1)

    def test_five_percent_are_found_between_programs_of_the_same_rounds(self) -> None:
        found, false = self.alarms(significance.signed_rank, 40, 0.05, common=True)
        self.assertGreaterEqual(found, 0.9 * TRIALS)
        self.assertLessEqual(false, 1)

    def test_nothing_is_found_where_there_is_nothing(self) -> None:
        for test, common in ((significance.mann_whitney, False), (significance.signed_rank, True)):
            found, false = self.alarms(test, 20, 0.0, common)
            self.assertLessEqual(found + false, 1)

    def test_the_counts_of_ranks_are_those_of_all_orders(self) -> None:
        for n, m in ((1, 1), (2, 3), (4, 3), (5, 5)):
            counted = np.zeros(n * m + 1)
            for places in itertools.combinations(range(n + m), n):
                counted[sum(places) - n * (n - 1) // 2] += 1
            np.testing.assert_array_equal(significance.rank_counts(n, m), counted)
        self.assertEqual(sum(significance.rank_counts(40, 30)), comb(70, 30))

    def test_chances_in_closed_form(self) -> None:
        self.assertAlmostEqual(significance.mann_whitney([5, 6, 7], [1, 2, 3], 0), 1 / comb(6, 3))
        self.assertAlmostEqual(significance.mann_whitney([1, 2, 3], [5, 6, 7], 0), 1.0)
        self.assertGreater(significance.mann_whitney([1, 1, 1], [1, 1, 1], 0), 0.5)
        self.assertAlmostEqual(significance.signed_rank([2, 3, 4, 5], [1, 1, 1, 1], 0), 1 / 2**4)
        self.assertAlmostEqual(significance.signed_rank([1, 1, 1], [2, 3, 4], 0), 1.0)
        self.assertEqual(significance.holm([0.004, 0.2, 0.001, 0.006], 0.01), [False, False, True, False])
        self.assertEqual(significance.holm([0.003, 0.2, 0.001, 0.005], 0.01), [True, False, True, True])
        self.assertAlmostEqual(significance.ratio([2, 4, 6], [1, 2, 3]), 2.0)


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.server = cls.enterClassContext(local())
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        (cls.folder / "wall.txtpb").write_text(SCENE)

    def run_bench(self, *words: str) -> tuple[int, str]:
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            code = main([str(self.folder / "wall.txtpb"), "--server", self.server.address, "--size", "16x8", "--rounds", "6",
                         *words])
        return code, out.getvalue()

    def test_a_record_of_all_cases_and_what_is_slower_than_it(self) -> None:
        file = self.folder / "now.json"
        code, out = self.run_bench("--method", "exact", "--method", "point { fitted: 8 }", "--samples", "1,4", "-o", str(file))
        self.assertEqual(code, 0)
        record = json.loads(file.read_text())
        names = {f"wall 16x8 {method} spp {spp}" for method in ("exact", "point { fitted: 8 }") for spp in (1, 4)}
        self.assertEqual(set(record["times"]), names)
        for times in record["times"].values():
            self.assertEqual({kind: len(values) for kind, values in times.items()}, {"seconds": 6, "cpu": 6, "wall": 6})
        self.assertTrue(all(record["machine"][key] for key in ("cpu", "host", "cores", "server", "commit", "build", "numpy")))
        self.assertTrue(all(name in out for name in names))

        # The same case, against a machine that was a thousand times as fast, or as slow.
        for factor, expected in ((1e-3, 1), (1e3, 0)):
            for times in record["times"].values():
                times["seconds"] = [factor * value for value in times["seconds"]]
            other = self.folder / "other.json"
            other.write_text(json.dumps(record))
            code, out = self.run_bench("--method", "exact", "--samples", "1", "--baseline", str(other))
            self.assertEqual(code, expected, out)
            record = json.loads(file.read_text())

    def test_two_programs_in_the_same_rounds(self) -> None:
        file = self.folder / "both.json"
        self.assertIn(self.run_bench("--against", str(BIN / "metamerd"), "-o", str(file))[0], (0, 1))
        record = json.loads(file.read_text())
        self.assertEqual(record["times"].keys(), record["against"]["times"].keys())
        self.assertEqual(record["machine"]["build"], record["against"]["machine"]["build"])

    def test_what_is_no_record_and_no_method(self) -> None:
        (self.folder / "bad.json").write_text("[]")
        self.assertEqual(self.run_bench("--baseline", str(self.folder / "bad.json"))[0], 2)
        self.assertEqual(self.run_bench("--method", "exakt")[0], 2)
        with self.assertRaises(errors.InputError):
            list(make_cases([self.folder / "none.txtpb"], [], [], [], None))


if __name__ == "__main__":
    unittest.main()
