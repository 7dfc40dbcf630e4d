# SPDX-License-Identifier: Apache-2.0
"""Where the trisect command is, and how it is run from Python."""
from __future__ import annotations

import os
import pathlib
import shutil
import sys
from typing import NoReturn, Optional


def find_command() -> Optional[str]:
    """The command that belongs to this package, else the one in the path."""
    own = pathlib.Path(__file__).resolve().parent / "bin" / "trisect"
    # The build tree has links to the sources; the command is beside the link.
    beside = pathlib.Path(os.path.abspath(__file__)).parent / "bin" / "trisect"
    for candidate in (beside, own):
        if candidate.is_file() and os.access(candidate, os.X_OK):
            return str(candidate)
    return shutil.which("trisect")


def main() -> NoReturn:
    """Runs the command in place of this process, with its arguments and exit code."""
    command = find_command()
    if command is None:
        sys.exit("trisect: the command is neither in the package nor in the path; build it with "
                 "TRISECT_BUILD_APPS or install it")
    os.execv(command, ["trisect", *sys.argv[1:]])
