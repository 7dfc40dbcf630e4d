# SPDX-License-Identifier: Apache-2.0
"""Validation with typed findings, and verification of results."""
import copy
import pickle

import numpy as np
import pytest

import trisect
from conftest import CUBE_TRIANGLES, CUBE_VERTICES
from trisect import DefectKind, Severity, Solid, Verdict


def test_a_good_mesh(cube):
    report = trisect.check(*cube.mesh())
    assert report.is_solid and not report and report.findings == []
    assert trisect.check(cube.mesh()).is_solid
    assert str(report).strip() == "no defects"
    assert report.rounding.lossless


def test_rounding_of_coordinates_that_span_too_many_bits(cube):
    v, f = cube.mesh()
    v[v[:, 0] == 0, 0] = 1e-300
    rounding = trisect.check(v, f).rounding
    assert not rounding.lossless and rounding.moved == 4 and 0 < rounding.max_move <= 1e-300


def test_findings_have_kinds_and_places(cube):
    v, f = cube.mesh()
    report = trisect.check(v, np.delete(f, 3, axis=0))
    assert not report.is_solid and report
    assert report.count(DefectKind.OPEN_EDGE) == 3
    assert report.count(Severity.ERROR) >= 3
    for finding in report.findings:
        if finding.kind == DefectKind.OPEN_EDGE:
            assert finding.severity == Severity.ERROR and len(finding.vertices) == 2
            assert "edge from vertex" in finding.sentence
    assert "open_edge" in str(report) and "errors" in repr(report)


def test_self_intersection():
    v, f = Solid.box((0, 0, 0), (2, 2, 2)).mesh()
    both = np.concatenate([v, v + 1]), np.concatenate([f, f + len(v)])
    assert trisect.check(*both).count(DefectKind.SELF_INTERSECTION) > 0
    assert trisect.check(*both, self_intersection=False).count(DefectKind.SELF_INTERSECTION) == 0
    few = trisect.check(*both, list_limit=1)
    kinds = [x.kind for x in few.findings]
    assert kinds.count(DefectKind.SELF_INTERSECTION) == 1


def test_verify_proves_results(two_boxes):
    a, b = (s.mesh() for s in two_boxes)
    result = (two_boxes[0] - two_boxes[1]).mesh()
    report = trisect.verify("difference", [a, b], result)
    assert report.verdict == Verdict.EQUAL and report.upper == 0 and report.witness is None


def test_verify_names_a_point_of_difference(two_boxes):
    a, b = (s.mesh() for s in two_boxes)
    report = trisect.verify("difference", [a, b], a)
    assert report.verdict == Verdict.DIFFERENT and report.lower > 0
    witness = report.witness
    assert witness.in_result and not witness.in_exact
    assert witness.winding == [1, 1, 1]
    assert all(1 <= x <= 2 for x in witness.exact_point())
    v, f = a
    near = v + np.array([1e-6, 0, 0]), f
    assert trisect.verify("union", [a], near, within=1e-5).verdict == Verdict.WITHIN
    assert trisect.verify("union", [a], (v, f[1:])).verdict == Verdict.NOT_CLOSED


def test_refused_operands(two_boxes):
    a, b = (s.mesh() for s in two_boxes)
    with pytest.raises(trisect.UsageError, match="operation"):
        trisect.verify("sum", [a, b], a)
    with pytest.raises(trisect.UsageError):
        trisect.verify("union", [], a)
    with pytest.raises(TypeError, match="operands: must be a pair"):
        trisect.verify("union", [3], a)


def test_reports_and_errors_go_to_other_processes():
    vertices, faces = CUBE_VERTICES, CUBE_TRIANGLES
    report = trisect.check(np.concatenate([vertices, [(9, 9, 9)]]), faces[2:], list_limit=2)
    again = pickle.loads(pickle.dumps(report))
    assert str(again) == str(report) and again.is_solid == report.is_solid
    assert [f.sentence for f in again.findings] == [f.sentence for f in report.findings]
    assert [f.faces for f in again.findings] == [f.faces for f in report.findings]
    for kind in trisect.DefectKind:
        assert again.count(kind) == report.count(kind)
    assert report.count(trisect.DefectKind.OPEN_EDGE) > 2
    assert again.rounding.lossless and str(copy.copy(report)) == str(report)
    with pytest.raises(trisect.InvalidSolid) as caught:
        trisect.Solid(vertices, faces[1:])
    error = pickle.loads(pickle.dumps(caught.value))
    assert isinstance(error, trisect.InvalidSolid) and str(error) == str(caught.value)
    assert str(error.report) == str(caught.value.report)
