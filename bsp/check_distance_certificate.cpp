// SPDX-License-Identifier: Apache-2.0
//
// The checker shares nothing with what decides: corners, the numbers of the poses, and fractions.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <trisect/bsp/detail/certified_triangles.h>
#include <trisect/bsp/distance_certificate.h>

namespace trisect {

namespace {

using Vector = RationalPoint;

ExactRational dot(const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

struct Side {
    const Brep& brep;
    const Pose& pose;
    std::vector<Vector> corners;
    const std::vector<CertifiedTriangle>& triangles;
    int sign;  // 1: below the slab, -1: above
};

class Checker {
public:
    Checker(const DistanceCertificate& c, const Brep& a, const Pose& pose_a, const Brep& b,
            const Pose& pose_b)
        : c_(c),
          a_{a, pose_a, detail::corners_in_world(a, pose_a), c.triangles_a, 1},
          b_{b, pose_b, detail::corners_in_world(b, pose_b), c.triangles_b, -1} {}

    std::string run() const {
        if (a_.brep.is_empty() || b_.brep.is_empty())
            return c_.is_complete ? "an empty solid has no distance" : "";
        if (!c_.is_complete && !c_.on_a.face.is_valid() && c_.slabs.empty()) return {};
        if (c_.squared.sign() < 0) return "the square is negative";
        if (!is_on(a_, c_.on_a) || !is_on(b_, c_.on_b)) return "a point is not on its face";
        Vector way;
        for (std::size_t k = 0; k < 3; ++k) way[k] = c_.on_b.point[k] - c_.on_a.point[k];
        if (c_.squared < dot(way, way)) return "the points are farther apart";
        if (c_.squared.sign() == 0) return {};
        if (c_.slabs.empty()) return c_.is_complete ? "there are no slabs" : "";
        return wrong_tree();
    }

private:
    static bool is_on(const Side& side, const PointOnFace& p) {
        return detail::is_on_face(p.point, p.face, side.brep, side.pose);
    }
    std::string wrong_tree() const {
        if (!detail::triangles_fill_faces(c_.triangles_a, a_.brep) ||
            !detail::triangles_fill_faces(c_.triangles_b, b_.brep))
            return "the triangles do not fill the faces";
        struct Range {
            std::size_t node, a0, a1, b0, b1;
        };
        std::vector<Range> open{{0, 0, c_.triangles_a.size(), 0, c_.triangles_b.size()}};
        std::vector<bool> seen(c_.slabs.size(), false);
        while (!open.empty()) {
            const Range r = open.back();
            open.pop_back();
            if (r.node >= c_.slabs.size() || seen[r.node]) return "the tree is no tree";
            seen[r.node] = true;
            const SlabNode& n = c_.slabs[r.node];
            if (n.kind == SlabNode::Kind::Separated) {
                if (!is_thick(n.slab)) return "a slab is thinner than the distance";
                if (!is_beside(n.slab.normal, n.slab.below, a_, r.a0, r.a1) ||
                    !is_beside(n.slab.normal, n.slab.above, b_, r.b0, r.b1))
                    return "triangles reach into a slab";
                continue;
            }
            const bool of_a = n.kind == SlabNode::Kind::SplitA;
            if ((of_a ? r.a1 - r.a0 : r.b1 - r.b0) < 2) return "the tree splits a single triangle";
            const std::size_t ma = (r.a0 + r.a1) / 2;
            const std::size_t mb = (r.b0 + r.b1) / 2;
            open.push_back({r.node + 1, r.a0, of_a ? ma : r.a1, r.b0, of_a ? r.b1 : mb});
            open.push_back({n.other, of_a ? ma : r.a0, r.a1, of_a ? r.b0 : mb, r.b1});
        }
        return {};
    }
    [[nodiscard]] bool is_thick(const Slab& s) const {
        const ExactRational thick = s.above - s.below;
        return thick.sign() > 0 && c_.squared * dot(s.normal, s.normal) <= thick * thick;
    }
    static bool is_beside(const Vector& normal, const ExactRational& height, const Side& side,
                          std::size_t from, std::size_t to) {
        for (const std::uint32_t v : detail::corners_of_range(side.triangles, from, to)) {
            const ExactRational x = dot(normal, side.corners[v]);
            if (side.sign > 0 ? height < x : x < height) return false;
        }
        return true;
    }

    const DistanceCertificate& c_;
    Side a_;
    Side b_;
};

}  // namespace

std::string check_distance_certificate(const DistanceCertificate& certificate, const Brep& a,
                                       const Pose& pose_a, const Brep& b, const Pose& pose_b) {
    return Checker(certificate, a, pose_a, b, pose_b).run();
}

}  // namespace trisect
