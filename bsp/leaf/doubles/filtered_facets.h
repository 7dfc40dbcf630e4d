// SPDX-License-Identifier: Apache-2.0
//
// FilteredFacets: polygons of a leaf in general position, in doubles (filtered_leaf.h).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/trace/interpolation.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/bsp/leaf/leaf_work.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/stamp_map.h>

namespace trisect::detail {

/// The support of a facet: points p with normal · (p - origin) = 0. Exact points of the leaf have a
/// value within `bound` of the computed one; points with an error add `slope` times that.
struct FilteredPlane {
    Vector3 origin;
    Vector3 normal;
    double slope;
    double bound = -1;  ///< -1: not made yet, and nothing else is set

    [[nodiscard]] double value(const Vector3& p) const {
        return (normal[0] * (p[0] - origin[0]) + normal[1] * (p[1] - origin[1])) +
               normal[2] * (p[2] - origin[2]);
    }
    [[nodiscard]] double error(const Approximation& p) const { return bound + slope * p.error; }
    /// -1 below, 1 above; 0 when doubles cannot decide.
    [[nodiscard]] int sign(const Approximation& p) const {
        const double v = value(p.c);
        const double e = error(p);
        return v > e ? 1 : (v < -e ? -1 : 0);
    }
};

/// A facet of an embedded operand, whole or a fragment of it. Its corners are lattice points, taken
/// from an origin of the leaf from which doubles hold them exactly and by which constructed points
/// have the errors of the leaf's size and not of its place. Those of a fragment's outline are
/// constructed.
///
/// Facets of half-spaces are always fragments here, and have no corners but those of the outline.
struct FilteredFacet {
    /// Fragments with more corners are left to the exact path.
    static constexpr std::size_t max_outline = 20;
    static constexpr std::uint32_t no_outline = ~0U;  ///< not made yet

    // Without this an item is filled with zeros before it is filled with what it has.
    FilteredFacet() {}  // NOLINT(modernize-use-equals-default)

    PolygonRef ref;
    LeafIndex operand = 0;
    LeafIndex surface = 0;  ///< one number for each operand and source in it
    std::int8_t orientation = 1;
    std::int8_t side_of_reference = 2;  ///< of the support; 0: cannot decide, 2: not computed
    bool contained = false;             ///< lies in the cell
    bool is_beyond = false;             ///< a fragment that ends, by name, where the cell begins
    std::uint8_t size = 3;              ///< corners of the outline
    std::uint8_t splitters = 0;  ///< of a fragment: bit 2 · axis, + 1 for the upper one, where it
                                 ///< ends at that bounding plane of the cell by name
    std::uint32_t outline = no_outline;  ///< of a fragment, see FilteredFacets::corner()
    /// Bit i: corner i of the outline lies in the support of some item of another operand whose box
    /// meets that of this one, so perhaps on that item.
    std::uint32_t resting = 0;
    // What FilteredFacets::list() always sets.
    std::array<std::uint32_t, 3> vertices;  ///< of the whole facet
    std::array<Vector3, 3> corners;         ///< of the whole facet
    Vector3 lo;                             ///< of the box, within the cell
    Vector3 hi;
    FilteredPlane plane;

    [[nodiscard]] bool is_whole() const { return ref.fragment == nullptr; }
    [[nodiscard]] bool is_of_half_space() const { return ref.source->is_half_space(); }
    /// The plane of an edge, from a corner of the outline to the next one.
    [[nodiscard]] EdgeName edge(std::size_t e) const {
        if (is_whole()) return {PlaneName::edge(ref.source, ref.facet, static_cast<int>(e)), false};
        return ref.fragment->edges()[e];
    }
    /// Which edge of the whole facet an edge of the outline lies in; -1 where something cut.
    [[nodiscard]] int mesh_edge(std::size_t e) const {
        if (is_whole()) return static_cast<int>(e);
        const PlaneName& name = ref.fragment->edges()[e].plane;
        return name.is_edge() && name.facet == ref.facet && name.source() == ref.source
                   ? static_cast<int>(name.kind)
                   : -1;
    }
    /// Which corner of the whole facet a corner of the outline is; -1 when it was constructed.
    [[nodiscard]] int mesh_corner(std::size_t c) const {
        if (is_whole()) return static_cast<int>(c);
        const int from = mesh_edge(c == 0 ? size - 1U : c - 1);
        const int to = mesh_edge(c);
        return from >= 0 && to >= 0 && to == (from + 1) % 3 ? to : -1;
    }

    [[nodiscard]] bool has_vertex(std::uint32_t v) const {
        return v == vertices[0] || v == vertices[1] || v == vertices[2];
    }
    [[nodiscard]] bool meets(const Vector3& low, const Vector3& high) const {
        return lo[0] <= high[0] && low[0] <= hi[0] && lo[1] <= high[1] && low[1] <= hi[1] &&
               lo[2] <= high[2] && low[2] <= hi[2];
    }
};

/// The polygons of one leaf after the other; keeps its memory.
class FilteredFacets {
public:
    /// False when something else than facets of embedded operands and fragments of such is listed,
    /// nothing but half-spaces is, or the leaf is too large for doubles. Of the plane of a
    /// half-space the part in the cell is listed, in pieces where the cell is much larger than what
    /// the leaf has of meshes.
    [[nodiscard]] bool list(const LeafProblem& leaf);

    [[nodiscard]] LeafIndex size() const { return static_cast<LeafIndex>(facets_.size()); }
    [[nodiscard]] FilteredFacet& operator[](LeafIndex i) { return facets_[as_index(i)]; }
    [[nodiscard]] const FilteredFacet& operator[](LeafIndex i) const {
        return facets_[as_index(i)];
    }
    [[nodiscard]] const FilteredPlane& plane(LeafIndex i) {
        FilteredFacet& f = facets_[as_index(i)];
        if (f.plane.bound < 0) {
            f.plane = f.is_of_half_space() ? plane_of_half_space(f) : plane_of(f.corners, extent_);
            make_outline(i);
        }
        return f.plane;
    }
    /// The plane of three points of a leaf of that extent.
    [[nodiscard]] static FilteredPlane plane_of(const std::array<Vector3, 3>& corners,
                                                const Vector3& extent);
    /// Corners of most fragments are never used.
    void make_outline(LeafIndex i) {
        FilteredFacet& f = facets_[as_index(i)];
        if (!f.is_whole() && f.outline == FilteredFacet::no_outline) add_outline(f);
    }
    /// A corner of an item's outline. \pre an item of which plane() or make_outline() was called
    [[nodiscard]] Approximation corner(const FilteredFacet& f, std::size_t i) const {
        return f.is_whole() ? Approximation{f.corners[i], 0.0} : outlines_[f.outline + i];
    }
    /// All of them, of a fragment.
    [[nodiscard]] const Approximation* outline(const FilteredFacet& f) const {
        return &outlines_[f.outline];
    }
    /// Whether all sources have whole coordinates; then so are the corners.
    [[nodiscard]] bool is_whole() const { return whole_; }
    /// How many fragments are listed.
    [[nodiscard]] std::size_t fragment_count() const { return fragments_; }
    [[nodiscard]] const LeafProblem& problem() const { return problem_; }
    [[nodiscard]] std::size_t operand_count() const { return problem_.operands.size(); }
    /// The first item of an operand, whose items follow each other; of the number of operands: the
    /// number of items.
    [[nodiscard]] LeafIndex first_of(std::size_t operand) const { return firsts_[operand]; }
    /// The box of all items of an operand.
    struct Reach {
        static constexpr double infinity = std::numeric_limits<double>::infinity();
        Vector3 lo{infinity, infinity, infinity};
        Vector3 hi{-infinity, -infinity, -infinity};
    };
    [[nodiscard]] const Reach& reach(std::size_t operand) const { return reaches_[operand]; }
    /// Whether a corner surely lies in the cell; of whole coordinates, whether it does.
    [[nodiscard]] bool in_cell(const Vector3& p) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] < inner_lo_[k] || p[k] > inner_hi_[k]) return false;
        return true;
    }
    /// The lattice positions next to the cell's bounding planes, inside of them; exact as far as
    /// corners go. Where there are fractions, the bounding planes drawn in by what they may be off.
    [[nodiscard]] const Vector3& inner_lo() const { return inner_lo_; }
    [[nodiscard]] const Vector3& inner_hi() const { return inner_hi_; }
    /// The splitting planes themselves, rounded: off by up to last_place of their size and
    /// splitter_error().
    [[nodiscard]] const Vector3& splitter_lo() const { return splitter_lo_; }
    [[nodiscard]] const Vector3& splitter_hi() const { return splitter_hi_; }
    [[nodiscard]] double splitter_error() const { return whole_ ? 0 : 0x1p-52; }
    [[nodiscard]] const Approximation& reference() const { return reference_; }
    /// How far apart whole facets' corners, the origin and the reference point are along each axis,
    /// and at least 1 where coordinates are whole.
    [[nodiscard]] const Vector3& extent() const { return extent_; }
    /// A point of the leaf in the lattice's coordinates.
    [[nodiscard]] Approximation in_lattice(Approximation at) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const double origin = origin_[k];
            at.c[k] += origin;
            at.error += 0x1p-51 * (std::fabs(at.c[k]) + std::fabs(origin));
        }
        return at;
    }
    /// The same the other way.
    [[nodiscard]] Approximation from_lattice(Approximation at) const {
        for (std::size_t k = 0; k < 3; ++k) {
            at.error += 0x1p-51 * (std::fabs(at.c[k]) + std::fabs(origin_[k]));
            at.c[k] -= origin_[k];
        }
        return at;
    }
    /// The positions that a box of the leaf meets, rounded outwards.
    [[nodiscard]] Box positions(const Vector3& lo, const Vector3& hi) const;

private:
    class Lister;
    void set_origin(const Vector3& origin);
    void set_bounds();
    void set_bounds_with_fractions();
    [[nodiscard]] Vector3 origin_of_fractions() const;
    void add(const PolygonRef& ref, const LeafOperand& operand, LeafIndex number,
             LeafIndex surface);
    void add_box(FilteredFacet& f);
    void add_outline(FilteredFacet& f);
    [[nodiscard]] FilteredPlane plane_of_half_space(const FilteredFacet& f) const;
    void make_pieces();
    void add_pieces(const PolygonRef& ref, std::size_t operand, const Box& meshes);
    void add_half_space(FilteredFacet& f);
    [[nodiscard]] bool is_contained_but_for_splitters(unsigned splitters, const Vector3& lo,
                                                      const Vector3& hi) const;
    void find_splitters(FilteredFacet& f) const;

    LeafProblem problem_;
    // Of a half-space in the cell.
    struct Piece {
        std::size_t operand = 0;
        PolygonRef ref;
    };

    std::vector<FilteredFacet> facets_;
    std::vector<LeafIndex> firsts_;  // by operand
    std::vector<Piece> pieces_;
    PolygonList kept_pieces_;              // owns them
    std::unique_ptr<Workbench> bench_;     // that cuts them
    std::vector<Approximation> outlines_;  // of fragments, one after the other
    std::vector<Reach> reaches_;           // by operand
    std::size_t fragments_ = 0;
    StampMap surfaces_;
    bool whole_ = true;
    Vector3 origin_{};                            // from where coordinates of this leaf count
    std::array<std::int64_t, 3> whole_origin_{};  // rounded down
    Approximation reference_;
    Vector3 inner_lo_{};
    Vector3 inner_hi_{};
    // A cell without lattice points still has an inside: boxes keep one unit around it.
    Vector3 outer_lo_{};
    Vector3 outer_hi_{};
    Vector3 splitter_lo_{};
    Vector3 splitter_hi_{};
    Vector3 extent_{};  // of all facets, unclipped, and the reference point
};

/// Sign of the determinant of (a - d, b - d, c - d), exact; nothing when corners are so far apart
/// that 128 bits do not hold it. \pre whole coordinates
[[nodiscard]] std::optional<int> exact_orientation(const Vector3& a, const Vector3& b,
                                                   const Vector3& c, const Vector3& d);

/// -1, 0, 1: the order of two points along an axis; 0 when doubles cannot decide.
[[nodiscard]] inline int compare_along(std::size_t axis, const Approximation& a,
                                       const Approximation& b) {
    const double gap = b.c[axis] - a.c[axis];
    const double error = bound_slack * (a.error + b.error);
    return gap > error ? -1 : (gap < -error ? 1 : 0);
}

/// The direction of the line in which two supports meet, the product of their normals: the axis
/// along which it is longest, and the sign there, 0 when doubles cannot decide. The left of it in
/// the first support is what is below the second one: n × (n × m) = -m within the support of n.
struct LineDirection {
    std::size_t axis = 0;
    int sign = 0;

    LineDirection(const FilteredPlane& first, const FilteredPlane& second) {
        const Vector3& n = first.normal;
        const Vector3& m = second.normal;
        const Vector3 d{n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2],
                        n[0] * m[1] - n[1] * m[0]};
        for (std::size_t k = 1; k < 3; ++k)
            if (std::fabs(d[k]) > std::fabs(d[axis])) axis = k;
        // Components err by less than 8 · 2^-53 times the slopes, which bound them.
        if (std::fabs(d[axis]) > 0x1p-47 * first.slope * second.slope) sign = d[axis] > 0 ? 1 : -1;
    }
    /// -1, 0, 1: the order of two points of the line; 0 when doubles cannot decide.
    [[nodiscard]] int order(const Approximation& a, const Approximation& b) const {
        return sign * compare_along(axis, a, b);
    }
};

}  // namespace trisect::detail
