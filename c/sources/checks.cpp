// SPDX-License-Identifier: Apache-2.0
//
// Validation of meshes, and verification of results.

#include <vector>

#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/verify.h>

#include "call.h"
#include "handles.h"
#include "mesh_input.h"
#include "operation.h"

using namespace trisect;  // NOLINT(google-build-using-namespace)
using c::required;

trisect_status trisect_check(const double* vertices, size_t vertex_count, const uint32_t* faces,
                             size_t face_count, trisect_report** report) {
    return c::make_handle(report, "report", [&] {
        return validate(c::triangles_of(vertices, vertex_count, faces, face_count));
    });
}

int trisect_report_is_solid(const trisect_report* report) {
    return report != nullptr && report->report.is_solid() ? 1 : 0;
}

size_t trisect_report_count(const trisect_report* report) {
    return report != nullptr ? report->report.defects().size() : 0;
}

trisect_status trisect_report_finding(const trisect_report* report, size_t index,
                                      trisect_finding* finding) {
    return c::call([&] {
        const std::vector<Defect>& defects = required(report, "report").report.defects();
        if (index >= defects.size())
            throw UsageError("index: " + std::to_string(index) + " of " +
                             std::to_string(defects.size()));
        const Defect& d = defects[index];
        required(finding, "finding") = {name_of(d.kind).data(),
                                        d.severity() == Severity::Error ? 1 : 0,
                                        {d.place[0], d.place[1], d.place[2]},
                                        d.sentence.c_str(),
                                        d.vertices.data(),
                                        d.vertices.size(),
                                        d.faces.data(),
                                        d.faces.size()};
    });
}

void trisect_report_free(trisect_report* report) { delete report; }

trisect_status trisect_verify(trisect_operation operation, const trisect_triangles* operands,
                              size_t count, const trisect_triangles* result, double within,
                              trisect_verdict* verdict, double* lower, double* upper) {
    return c::call([&] {
        static_assert(static_cast<int>(Verdict::NotClosed) == TRISECT_VERDICT_NOT_CLOSED);
        (void)required(verdict, "verdict");
        std::vector<PolygonMesh> meshes;
        for (const trisect_triangles& t : c::array_of(operands, count, "operands"))
            meshes.push_back(c::triangles_of(t.vertices, t.vertex_count, t.faces, t.face_count));
        const trisect_triangles& made = required(result, "result");
        VerifyOptions options;
        options.evaluate.threads = c::limits_of_thread().threads;
        if (!(within < 0)) options.within = within;
        const VerifyReport report =
            verify(c::operation_of(operation), meshes,
                   c::triangles_of(made.vertices, made.vertex_count, made.faces, made.face_count),
                   options);
        *verdict = static_cast<trisect_verdict>(report.verdict);
        if (lower != nullptr) *lower = report.lower;
        if (upper != nullptr) *upper = report.upper;
    });
}
