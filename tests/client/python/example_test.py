"""The example beside the package runs, and two paints that match under D65 part under F11."""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from support import BIN

EXAMPLE = pathlib.Path(__file__).resolve().parents[3] / "client" / "python" / "examples" / "two_paints.py"


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "python3-matplotlib is missing")
class Example(unittest.TestCase):
    def test_two_paints(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            said = subprocess.run([sys.executable, "-B", EXAMPLE, f"{folder}/figure.png", BIN / "metamerd"], check=True,
                                  stdout=subprocess.PIPE, text=True, env=os.environ | {"MPLCONFIGDIR": folder}).stdout
            self.assertGreater(os.path.getsize(f"{folder}/figure.png"), 10_000)
        differences = {line.split(": ")[0]: float(line.split(": ")[1]) for line in said.splitlines()}
        self.assertLess(differences["D65"], 0.01)
        self.assertGreater(differences["F11"], 3)


if __name__ == "__main__":
    unittest.main()
