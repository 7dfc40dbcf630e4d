# SPDX-License-Identifier: Apache-2.0
"""Pages in notebooks."""
import html
import re

import pytest

import trisect
from trisect import pages
from trisect._command import find_command

pytestmark = pytest.mark.skipif(find_command() is None, reason="the command is not built")


def facts_of(page):
    return re.search(r'<script id="facts" type="application/json">(.*?)</script>', page.text, re.DOTALL)[1]


def test_a_solid_shows_itself(two_boxes):
    a, b = two_boxes
    frame = (a - b)._repr_html_()
    assert frame.startswith("<iframe srcdoc=")
    text = html.unescape(re.search(r'srcdoc="(.*?)" title', frame, re.DOTALL)[1])
    assert text.startswith("<!DOCTYPE html>") and text.rstrip().endswith("</html>")


@pytest.mark.parametrize("solid", [trisect.Solid.half_space([1, 0, 0, 0]), trisect.Solid.whole_space()])
def test_what_is_unbounded_shows_its_text(solid):
    assert solid._repr_html_() is None


def test_operands_have_names(two_boxes, tmp_path):
    page = pages.view(*two_boxes, operation="difference", names=["plate", "tool"])
    assert "plate" in facts_of(page) and "tool" in facts_of(page)
    page.write(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == page.text


def test_relations_under_poses():
    box = trisect.Solid.box((0, 0, 0), (1, 1, 1))
    page = pages.interfere(box, box, pose_b=trisect.Pose.from_translation((1, 0, 0)))
    assert '"touching"' in facts_of(page)
    page = pages.interfere(box, box, pose_b=[[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0]])
    assert '"disjoint"' in facts_of(page) and '"distance 2"' in facts_of(page)


def test_trees_and_findings(two_boxes, tmp_path):
    assert '"page":"tree"' in facts_of(pages.tree(two_boxes[0] - two_boxes[1]))
    mesh = tmp_path / "open.off"
    mesh.write_text("OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n")
    assert "open edge" in facts_of(pages.check(mesh))


def test_errors_are_those_of_the_command(tmp_path):
    with pytest.raises(trisect.Error):
        pages.check(tmp_path / "missing.off")
