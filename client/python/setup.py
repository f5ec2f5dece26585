"""Builds the package: beside what pyproject.toml says, protoc writes metamer/v1 from the messages in ../../proto."""
import os
import pathlib
import subprocess

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
PROTO = HERE.parent.parent / "proto"


class BuildWithMessages(build_py):
    def run(self) -> None:
        super().run()
        to = pathlib.Path(self.build_lib).resolve()
        subprocess.run([os.environ.get("PROTOC", "protoc"), f"-I{PROTO}", f"--python_out={to}", f"--pyi_out={to}"]
                       + sorted(PROTO.glob("metamer/v1/*.proto")), check=True)


setup(cmdclass={"build_py": BuildWithMessages})
