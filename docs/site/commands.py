# SPDX-License-Identifier: Apache-2.0
"""The reference of the command, as it prints it itself.

    commands.py TRISECT > commands.md
"""

import re
import subprocess
import sys


def help_of(*words: str) -> str:
    return subprocess.run([*words, "--help"], capture_output=True, text=True, check=True).stdout.strip()


def main(command: str) -> None:
    top = help_of(command)
    print("# The command\n")
    print(f"```text\n{top}\n```\n")
    listed = top.split("Subcommands:\n", 1)[1].split("\n\n", 1)[0]
    for name in re.findall(r"^  ([a-z][a-z-]*) ", listed, re.MULTILINE):
        print(f"## {name}\n\n```text\n{help_of(command, name)}\n```\n")


if __name__ == "__main__":
    main(sys.argv[1])
