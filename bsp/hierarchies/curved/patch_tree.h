// SPDX-License-Identifier: Apache-2.0
//
// PatchTree: a bounding volume hierarchy over Bézier patches.
// Above the patches it is a tree of boxes, below each patch a tree of its halves, whose volumes
// are the convex hulls of their control points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/curved/bezier_patch.h>
#include <trisect/brep/curved/control_net.h>

namespace trisect::hierarchies {

/// A point of one of the patches.
struct SurfacePoint {
    std::uint32_t patch = 0;
    double u = 0;
    double v = 0;
};

/// A part is a set of whole patches or a rectangle of one patch's parameters. Halves are made on
/// demand and kept, so a tree grows where queries look. Halving is that of Lane and Riesenfeld
/// (1980).
///
/// For one thread at a time: queries change it.
class PatchTree {
public:
    using Part = std::uint32_t;
    static constexpr Part root = 0;

    /// \throw UsageError when there are no patches.
    explicit PatchTree(std::span<const BezierPatch> patches);

    /// The surface of a part is within `radius` of the convex hull of these points.
    struct Hull {
        std::span<const Point3d> points;
        double radius = 0;
    };
    [[nodiscard]] Hull hull(Part part) const;
    /// A bound on how large the part is.
    [[nodiscard]] double extent(Part part) const { return parts_[part].extent; }
    /// Whether a part of one patch.
    [[nodiscard]] bool is_surface(Part part) const { return parts_[part].net != no_net; }
    /// The two halves; the same number twice when a part is too small to be halved.
    [[nodiscard]] std::array<Part, 2> halves(Part part);

    /// Points of a part of one patch with their parameters: corners and the middle.
    struct Sample {
        SurfacePoint at;
        CertifiedPoint point;
    };
    [[nodiscard]] const std::array<Sample, 5>& samples(Part part);

    [[nodiscard]] std::size_t part_count() const { return parts_.size(); }
    [[nodiscard]] std::size_t bytes() const;

private:
    static constexpr std::uint32_t no_net = 0xffffffffU;

    struct Data {
        std::vector<Point3d> points;
        double radius = 0;
        double extent = 0;
        std::uint32_t net = no_net;
        std::uint32_t patch = 0;
        std::array<double, 2> from{};  // parameters
        std::array<double, 2> to{1, 1};
        std::array<Part, 2> child{};  // 0: none yet
        std::uint32_t samples = no_net;
    };

    Part add_group(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
                   std::span<const BezierPatch> patches);
    Part add_surface(detail::ControlNet net, std::uint32_t patch, const std::array<double, 2>& from,
                     const std::array<double, 2>& to);

    std::vector<Data> parts_;
    std::vector<detail::ControlNet> nets_;
    std::vector<std::array<Sample, 5>> samples_;
};

}  // namespace trisect::hierarchies
