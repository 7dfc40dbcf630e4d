# SPDX-License-Identifier: Apache-2.0
"""`python -m trisect` is the command."""
import subprocess
import sys

import pytest

import trisect
from trisect._command import find_command


def run(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "trisect", *arguments], capture_output=True, text=True, check=False
    )


@pytest.mark.skipif(find_command() is None, reason="the command is not built")
def test_python_m_trisect_is_the_command(tmp_path, two_boxes):
    assert "union" in run("--help").stdout
    a, b, result = (str(tmp_path / name) for name in ("a.off", "b.off", "result.off"))
    two_boxes[0].write(a)
    two_boxes[1].write(b)
    done = run("difference", a, b, "-o", result)
    assert done.returncode == 0, done.stderr
    assert trisect.Solid.read(result).equals(two_boxes[0] - two_boxes[1])
    assert run("info", str(tmp_path / "missing.off")).returncode == 3
