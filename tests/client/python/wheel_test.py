"""The package builds as Debian builds it, without a network, and is whole."""
import ast
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[3]


@unittest.skipUnless(importlib.util.find_spec("build") and importlib.util.find_spec("wheel"), "python3-build is missing")
class Wheel(unittest.TestCase):
    def test_a_wheel_has_the_messages_and_the_benchmark(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for part in ("client/python", "proto"):  # a build leaves its folders beside its sources
                shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns("build", "*.egg-info"))
            ended = subprocess.run([sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", folder,
                                    folder / "client/python"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(ended.returncode, 0, ended.stdout)
            (wheel,) = folder.glob("metamer-*-py3-none-any.whl")
            with zipfile.ZipFile(wheel) as held:
                names = held.namelist()
                (entry,) = (name for name in names if name.endswith("/entry_points.txt"))
                self.assertIn("metamer-bench = metamer.bench:main", held.read(entry).decode())
            sources = {path.relative_to(ROOT / "client/python").as_posix()
                       for path in (ROOT / "client/python/metamer").rglob("*.py")}
            self.assertLessEqual(sources | {"metamer/v1/envelope_pb2.py", "metamer/py.typed"}, set(names))
            subprocess.run([sys.executable, "-B", "-c", "import metamer.bench; metamer.Scene.parse('camera {}')"], check=True,
                           env={"PYTHONPATH": str(wheel)}, cwd=folder)


class Imports(unittest.TestCase):
    def test_the_package_takes_python_numpy_and_protobuf_alone(self) -> None:
        allowed = sys.stdlib_module_names | {"numpy", "google", "metamer"}
        for path in (ROOT / "client/python/metamer").rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text())):
                names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
                names += [name.name for name in node.names] if isinstance(node, ast.Import) else []
                for name in names:
                    self.assertIn(name.split(".")[0], allowed, path.name)


if __name__ == "__main__":
    unittest.main()
