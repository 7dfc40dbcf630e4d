# SPDX-License-Identifier: Apache-2.0
"""Pages that show solids in a browser, and in notebooks.

A page is one HTML file that loads nothing. The command makes it, so it has to be in the package or in the path.

>>> from trisect import pages
>>> pages.view(part)                        # in a notebook: shown below the cell
>>> pages.view(a, b, operation="difference").write("page.html")
>>> pages.interfere(shaft, hub, pose_b=pose)

A solid that is the last line of a cell is shown, too.
"""
from __future__ import annotations

import html
import os
import pathlib
import subprocess
import tempfile
from typing import Any, List, Optional, Sequence, Union

from ._command import find_command
from ._errors import Error, UnsupportedError
from ._trisect import Pose, Solid

__all__ = ["Page", "check", "interfere", "tree", "view"]

#: Solids of more triangles are not shown unasked, below a cell.
MOST_TRIANGLES = 200_000

_Pose = Union[Pose, Sequence[Sequence[float]], Any]


class Page:
    """A page as text. Notebooks show it in a frame."""

    def __init__(self, text: str, height: int = 460) -> None:
        self.text = text
        self.height = height

    def write(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Write it to a file, which browsers open from the disk."""
        pathlib.Path(path).write_text(self.text, encoding="utf-8")

    def __repr__(self) -> str:
        return f"<trisect.pages.Page: {len(self.text)} characters>"

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{html.escape(self.text)}" title="a solid, to be turned" '
            f'style="width: 100%; height: {self.height}px; border: 1px solid #8888"></iframe>'
        )


def view(*solids: Solid, operation: str = "union", names: Optional[Sequence[str]] = None) -> Page:
    """A solid, or several combined: 'union', 'intersection', 'difference', 'xor'."""
    return _page("view", solids, names, ["--op", operation], "-o")


def tree(*solids: Solid, operation: str = "union", names: Optional[Sequence[str]] = None) -> Page:
    """The partitions behind a solid, level by level, through which points are followed."""
    return _page("tree", solids, names, ["--op", operation])


def interfere(
    a: Solid,
    b: Solid,
    pose_a: Optional[_Pose] = None,
    pose_b: Optional[_Pose] = None,
    names: Optional[Sequence[str]] = None,
) -> Page:
    """How two solids under poses lie to each other, with all that they have in common.

    Poses are taken as doubles: matrices of three or four rows.
    """
    return _page("interfere", [a, b], names, ["--distance"], poses=[pose_a, pose_b])


def check(path: Union[str, "os.PathLike[str]"]) -> Page:
    """A mesh file, with what is wrong with it at its places."""
    return _page("check", [], None, [os.fspath(path)])


def _page(
    command: str,
    solids: Sequence[Solid],
    names: Optional[Sequence[str]],
    options: List[str],
    output: str = "--page",
    poses: Sequence[Optional[_Pose]] = (),
) -> Page:
    program = find_command()
    if program is None:
        raise UnsupportedError("pages are made by the trisect command, which is not there")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        words = [program, "-q", command]
        for i, solid in enumerate(solids):
            # Each in a folder of its own, so that names may be equal.
            file = folder / str(i) / ((names[i] if names else f"solid {i + 1}") + ".trisect")
            file.parent.mkdir()
            solid.write(file)
            words.append(str(file))
        for letter, pose in zip("ab", poses):
            if pose is not None:
                words += [f"--pose-{letter}", _pose_file(folder / f"pose_{letter}.txt", pose)]
        page = folder / "page.html"
        done = subprocess.run(
            [*words, *options, output, str(page)], capture_output=True, text=True, check=False
        )
        if done.returncode > 1:
            raise Error(done.stderr.strip())
        return Page(page.read_text(encoding="utf-8"))


def _pose_file(path: pathlib.Path, pose: _Pose) -> str:
    rows = pose.matrix() if isinstance(pose, Pose) else pose
    numbers = [float(x) for row in list(rows)[:3] for x in row]
    path.write_text(" ".join(map(repr, numbers)) + "\n")
    return str(path)


def solid_repr_html(self: Solid) -> Optional[str]:
    """The frame of a notebook; nothing, so that the text is shown, where there can be no page."""
    try:
        if not 0 < self.triangle_count <= MOST_TRIANGLES or find_command() is None:
            return None
        return view(self)._repr_html_()
    except Error:
        return None
