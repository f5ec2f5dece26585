"""Builds the package: beside what pyproject.toml says, protoc writes metamer/v1 from the messages in ../../proto,
and the CIE's observers are copied out of Debian's colord-data. Nothing that is generated is committed."""
import os
import pathlib
import shutil
import subprocess

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
PROTO = HERE.parent.parent / "proto"
# What clients and servers say to each other, and what it imports.
MESSAGES = ["assets", "envelope", "factors", "fresnel", "geometry", "jobs", "material", "plan", "problem", "scene",
            "session", "spectrum", "views"]
# As common/spectral/embed_cie.cmake.
COLORD = pathlib.Path(os.environ.get("METAMER_COLORD_DATA", "/usr/share/colord"))
OBSERVERS = ["CIE1931-2deg-XYZ.cmf", "CIE1964-10deg-XYZ.cmf"]


class BuildWithMessages(build_py):
    def run(self) -> None:
        super().run()
        to = pathlib.Path(self.build_lib).resolve()
        subprocess.run([os.environ.get("PROTOC", "protoc"), f"-I{PROTO}", f"--python_out={to}", f"--pyi_out={to}"]
                       + [f"metamer/v1/{name}.proto" for name in MESSAGES], check=True, cwd=PROTO)
        for name in OBSERVERS:
            shutil.copyfile(COLORD / "cmf" / name, to / "metamer" / name)


setup(cmdclass={"build_py": BuildWithMessages})
