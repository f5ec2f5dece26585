"""What the package's README shows does what it says."""
import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest
from unittest import mock

from support import BIN, SCENE, local

README = pathlib.Path(__file__).resolve().parents[3] / "client" / "python" / "README.md"


class Readme(unittest.TestCase):
    def test_its_code_runs(self) -> None:
        first, *others = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
        self.assertLessEqual(len(first.strip().splitlines()), 10)
        self.enterContext(mock.patch.dict(os.environ, {"PATH": f"{BIN}:{os.environ['PATH']}"}))
        self.enterContext(contextlib.chdir(self.enterContext(tempfile.TemporaryDirectory())))
        said = self.enterContext(contextlib.redirect_stdout(io.StringIO()))
        pathlib.Path("scene.txtpb").write_text(SCENE)

        known: dict = {}
        exec(first, known)
        self.assertTrue(os.path.getsize("as-it-is.png") and os.path.getsize("f11.png"))
        self.assertIn(" tile\n", said.getvalue())
        with local() as known["server"]:
            for code in others:
                exec(code, known)
        self.assertEqual(len(known["table"]), 4)
        self.assertIn("grey", said.getvalue())


if __name__ == "__main__":
    unittest.main()
