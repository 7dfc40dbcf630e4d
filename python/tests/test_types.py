# SPDX-License-Identifier: Apache-2.0
"""The stubs agree with the module, and programs that use it are checked by mypy."""
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import trisect

pytest.importorskip("mypy")

PACKAGE = pathlib.Path(os.path.abspath(trisect.__file__)).parent

PROGRAM = '''
from fractions import Fraction

import numpy as np
import trisect
from trisect import Solid

a = Solid(np.zeros((4, 3)), np.zeros((4, 3), dtype=np.int32), embedding="check")
b = Solid.box((0, 0, 0), (1, 1, 1))
c: Solid = (a | b) - b & ~a ^ b
vertices, faces = c.mesh()
v, f, s = c.mesh(sources=True)
reveal: Fraction = c.exact_volume()
with trisect.limits(threads=1, progress=lambda seconds, steps: seconds < 3):
    d = trisect.union([a, trisect.Formula(b)])
place: trisect.Place = b.locate((0.5, 0.5, 0.5))
inside: bool = place == trisect.Location.INSIDE or trisect.Location.INSIDE == place
locations = b.locate([(0.5, 0.5, 0.5), (1.5, 0.5, 0.5)]) == trisect.Location.INSIDE
relation: trisect.Relation = trisect.interfere(a, None, b, np.eye(4)).relation
'''

WRONG = '''
from trisect import Solid

a = Solid([[0, 0, 0]], [[0, 0, 0]], embedding="perhaps")
b: str = Solid().volume
c = Solid() | 3
'''

# Of pybind11's classes: their metaclass, and constructors without a signature.
ALLOWED = r'''
trisect\._trisect\.([A-Z]\w*|limits)
trisect\._trisect\.(\w+\.)*__init__
'''


def mypy(tmp_path, *arguments):
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
    return subprocess.run(
        [sys.executable, "-m", *arguments],
        cwd=tmp_path, env=environment, capture_output=True, text=True, check=False,
    )


def test_the_package_is_typed(tmp_path):
    done = mypy(tmp_path, "mypy", "--strict", "--ignore-missing-imports", "-p", "trisect")
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_agree_with_the_module(tmp_path):
    (tmp_path / "allowed.txt").write_text(ALLOWED)
    done = mypy(tmp_path, "mypy.stubtest", "--allowlist", "allowed.txt",
                "--ignore-unused-allowlist", "trisect._trisect")
    assert done.returncode == 0, done.stdout + done.stderr


def test_programs_are_checked(tmp_path):
    (tmp_path / "program.py").write_text(PROGRAM)
    done = mypy(tmp_path, "mypy", "--strict", "program.py")
    assert done.returncode == 0, done.stdout + done.stderr
    (tmp_path / "wrong.py").write_text(WRONG)
    done = mypy(tmp_path, "mypy", "--strict", "wrong.py")
    assert done.stdout.count("error:") >= 3, done.stdout


def test_everything_public_has_a_docstring():
    missing = []
    for name in trisect.__all__:
        thing = getattr(trisect, name)
        if name.startswith("_"):
            continue
        if not inspect.getdoc(thing):
            missing.append(name)
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            missing += [
                f"{name}.{member}"
                for member, value in vars(thing).items()
                if not member.startswith("_")
                and (inspect.isroutine(value) or isinstance(value, (property, staticmethod)))
                and not inspect.getdoc(getattr(thing, member) if not isinstance(value, property) else value)
            ]
    assert missing == []
