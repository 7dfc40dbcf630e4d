// SPDX-License-Identifier: Apache-2.0
//
// One wrong field of a certificate after the other, each with what a checker must say about it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/interference_certificate.h>

namespace refusals {

template <class Certificate>
struct Change {
    const char* refusal;  ///< "" where what is left still holds
    std::function<void(Certificate&)> make;
};

/// `c.check` accepts the certificate, and says of each change of it what is expected.
/// Clang 14 has no std::source_location.
template <class Case, class Certificate>
void expect_refused(const Case& c, const Certificate& right,
                    const std::vector<Change<Certificate>>& changes, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    ASSERT_EQ(c.check(right), "");
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Certificate wrong = right;
        changes[i].make(wrong);
        EXPECT_EQ(c.check(wrong), changes[i].refusal) << "change " << i;
    }
}

/// Ways in which triangles do not fill the faces of a boundary, for each member that lists some.
template <class Certificate>
std::vector<Change<Certificate>> of_triangles(
    std::vector<trisect::CertifiedTriangle> Certificate::*triangles) {
    const char* refusal = "the triangles do not fill the faces";
    return {
        {refusal, [=](Certificate& c) { (c.*triangles).pop_back(); }},
        {refusal, [=](Certificate& c) { (c.*triangles).push_back((c.*triangles).front()); }},
        {refusal, [=](Certificate& c) { (c.*triangles)[1].face = trisect::FaceId(); }},
        {refusal, [=](Certificate& c) { (c.*triangles)[1].vertex[2] = trisect::VertexId(); }},
        // Of another face, in another plane.
        {refusal,
         [=](Certificate& c) {
             auto& t = c.*triangles;
             for (auto& u : t)
                 if (u.face != t[0].face) {
                     t[0].face = u.face;
                     break;
                 }
         }},
        // Seen from within.
        {refusal,
         [=](Certificate& c) {
             auto& t = (c.*triangles)[0];
             std::swap(t.vertex[0], t.vertex[1]);
         }},
    };
}

/// The opposite of a plane.
inline void turn_over(trisect::SeparatingPlane& plane) {
    for (trisect::ExactRational& x : plane.normal) x = -x;
    plane.offset = -plane.offset;
}

}  // namespace refusals
