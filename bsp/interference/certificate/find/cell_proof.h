// SPDX-License-Identifier: Apache-2.0
//
// Search for proofs by convex cells.
// Space is divided by planes until no cell has points of both boundaries in it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/certificate/find/gmp_vector.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

using ConvexPolygon = std::vector<GmpVector>;

/// What is looked for.
struct CellGoal {
    /// On which side of A a cell without a piece of its boundary must be to be done with, if any;
    /// likewise of B.
    bool a_outside_is_enough = false;
    bool a_inside_is_enough = false;
    bool b_outside_is_enough = false;
    bool b_inside_is_enough = false;
    /// Cells at most.
    std::size_t limit = 20000;
};

/// Location of a point of the world that is on no boundary.
using IsInside = std::function<bool(const ExactPoint&)>;

/// A tree of cells in which every leaf is done with, in preorder; nothing when the goal cannot be
/// reached or the limit is. Triangles are given in the world. `visit`, if given, is called with a
/// point of each leaf and whether it is inside of A and of B, when both boundaries miss the leaf;
/// then leaves without boundaries are always done with, and it may stop the search by returning
/// true.
class CellProof {
public:
    using Visit = std::function<bool(const ExactPoint&, bool in_a, bool in_b)>;

    CellProof(IsInside in_a, IsInside in_b, CellGoal goal, Visit visit = {})
        : in_a_(std::move(in_a)), in_b_(std::move(in_b)), goal_(goal), visit_(std::move(visit)) {}

    [[nodiscard]] std::optional<std::vector<CertifiedCell>> run(std::vector<ConvexPolygon> a,
                                                                std::vector<ConvexPolygon> b);

private:
    // normal·x + offset, with a sign on each side.
    struct Bound {
        GmpVector normal;
        mpq_class offset;
        int side = 0;
    };
    using Polygons = std::vector<ConvexPolygon>;

    enum class Progress : std::uint8_t { Done, Failed, Stopped };

    Progress divide(const Polygons& a, const Polygons& b, const GmpVector& point, int depth);
    [[nodiscard]] std::optional<CertifiedCell::Kind> verdict(const Polygons& a, const Polygons& b,
                                                             const GmpVector& point);
    [[nodiscard]] bool is_within(const GmpVector& p) const;
    [[nodiscard]] GmpVector point_beside(const Bound& cut, const Polygons& a, const Polygons& b,
                                         const GmpVector& point, int side) const;

    IsInside in_a_;
    IsInside in_b_;
    CellGoal goal_;
    Visit visit_;
    std::vector<CertifiedCell> cells_;
    std::vector<Bound> path_;
    bool stopped_ = false;
};

}  // namespace trisect::detail
