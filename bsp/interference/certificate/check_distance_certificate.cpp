// SPDX-License-Identifier: Apache-2.0
//
// The checker shares nothing with what decides: corners, the numbers of the poses, and fractions.

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/certified_walk.h>
#include <trisect/bsp/interference/distance_certificate.h>

namespace trisect::detail::certified {

namespace {

class DistanceChecker {
public:
    DistanceChecker(const DistanceCertificate& c, const Brep& a, const Pose& pose_a, const Brep& b,
                    const Pose& pose_b)
        : c_(c), a_(a, pose_a), b_(b, pose_b) {}

    std::string run() const {
        if (a_.brep().is_empty() || b_.brep().is_empty())
            return c_.is_complete ? "an empty solid has no distance" : "";
        if (!c_.is_complete && !c_.on_a.face.is_valid() && c_.slabs.empty()) return {};
        if (c_.squared.sign() < 0) return "the square is negative";
        if (!a_.is_on_face(c_.on_a.face, c_.on_a.point) ||
            !b_.is_on_face(c_.on_b.face, c_.on_b.point))
            return "a point is not on its face";
        const ExactPoint way = detail::certified::minus(c_.on_b.point, c_.on_a.point);
        if (c_.squared < dot(way, way)) return "the points are farther apart";
        if (c_.squared.sign() == 0) return {};
        if (c_.slabs.empty()) return c_.is_complete ? "there are no slabs" : "";
        if (!a_.is_filled_by(c_.triangles_a) || !b_.is_filled_by(c_.triangles_b))
            return "the triangles do not fill the faces";
        return detail::certified::wrong_tree(
            c_.slabs, WalkRange<NoTime>{0, c_.triangles_a.size(), 0, c_.triangles_b.size(), {}, {}},
            [this](const SlabNode& node, const WalkRange<NoTime>& r) {
                return wrong_slab(node.slab, r);
            });
    }

private:
    [[nodiscard]] std::string wrong_slab(const Slab& s, const WalkRange<NoTime>& r) const {
        const ExactRational thick = s.above - s.below;
        if (thick.sign() <= 0 || thick * thick < c_.squared * dot(s.normal, s.normal))
            return "a slab is thinner than the distance";
        return is_beyond(s.normal, s.below, a_, corners_of_a(c_.triangles_a, r), -1) &&
                       is_beyond(s.normal, s.above, b_, corners_of_b(c_.triangles_b, r), 1)
                   ? ""
                   : "triangles reach into a slab";
    }
    // At a height or beyond it.
    static bool is_beyond(const ExactPoint& normal, const ExactRational& height,
                          const Boundary& boundary, const std::vector<std::uint32_t>& corners,
                          int side) {
        const IntegerPlane plane(SeparatingPlane{normal, -height});
        return std::ranges::all_of(
            corners, [&](std::uint32_t v) { return plane.side_of(boundary.points()[v]) != -side; });
    }

    const DistanceCertificate& c_;
    Boundary a_;
    Boundary b_;
};

}  // namespace

}  // namespace trisect::detail::certified

namespace trisect {

std::optional<Refusal> check(const DistanceCertificate& certificate, const Brep& a,
                             const Pose& pose_a, const Brep& b, const Pose& pose_b) {
    std::string reason =
        detail::certified::DistanceChecker(certificate, a, pose_a, b, pose_b).run();
    if (reason.empty()) return std::nullopt;
    return Refusal{std::move(reason)};
}

}  // namespace trisect
