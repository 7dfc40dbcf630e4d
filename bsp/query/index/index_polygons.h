// SPDX-License-Identifier: Apache-2.0
//
// IndexPolygons: the polygons of a leaf under consecutive numbers.
// Planes, corners and names of the polygons are here.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/query/index/double_box.h>
#include <trisect/kernel/convex_polygon.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

/// Facets and fragments that a leaf lists.
///
/// Within the open cell they are the boundary, each point of it in the interior of one polygon
/// except where polygons end. A polygon may reach out of the cell; what of it is beyond says
/// nothing, since there something may have cut it. Nor does one that misses the open cell: it is
/// listed by its box.
///
/// The number of a facet of a mesh that nothing has happened to is its own: then there is no table
/// at all. Otherwise a polygon takes 16 bytes, and what is not a whole triangle 8 more. Sources and
/// fragments must outlive the table.
class IndexPolygons {
public:
    using Id = std::uint32_t;

    IndexPolygons() = default;
    /// Those of a list whose boxes meet the cell.
    IndexPolygons(const PolygonList& list, const Cell& cell);

    static constexpr Id none = 0xffffffffU;

    /// The cell that the polygons are listed in.
    [[nodiscard]] const Cell& cell() const { return cell_; }
    [[nodiscard]] std::uint32_t size() const { return size_; }
    /// Whether all sources are whole, those of edges included.
    [[nodiscard]] bool is_whole() const { return whole_; }
    /// No table: polygon i is facet i of the one source.
    [[nodiscard]] const Source* only_source() const { return only_; }

    [[nodiscard]] bool is_triangle(Id id) const {
        return only_ != nullptr || records_[id].fragment == triangle;
    }
    [[nodiscard]] const Source& source(Id id) const {
        return only_ != nullptr ? *only_ : *records_[id].source;
    }
    [[nodiscard]] std::uint32_t facet(Id id) const {
        return only_ != nullptr ? id : records_[id].facet;
    }
    /// Whether it may reach out of the cell.
    [[nodiscard]] bool reaches_out(Id id) const {
        return only_ == nullptr && records_[id].reaches_out != 0;
    }
    /// What of it is in the cell, seen from above the support; itself where it does not reach out.
    /// Exact: some microseconds. \pre it is bounded, or reaches out.
    [[nodiscard]] ConvexPolygon part(Id id) const;
    /// Whether it has a point in the open cell.
    [[nodiscard]] bool enters(Id id) const;
    /// Whether outside is below the support of the source's facet.
    [[nodiscard]] bool is_flipped(Id id) const {
        return only_ == nullptr && records_[id].flipped != 0;
    }
    /// Corner i of the source's triangle, whether or not the polygon is all of it.
    [[nodiscard]] const LatticePoint& corner(Id id, int i) const {
        return source(id).corner(facet(id), i);
    }
    /// The support as the source has it.
    [[nodiscard]] Plane support(Id id) const { return source(id).support(facet(id)); }
    /// Its normal outward.
    [[nodiscard]] Plane outward(Id id) const {
        const Plane p = support(id);
        return is_flipped(id) ? p.flipped() : p;
    }
    /// The planes of the edges, below which it lies, in the order of its corners; none for a facet
    /// that is a whole plane. Made from names: about 0.1 us each.
    [[nodiscard]] std::vector<Plane> edges(Id id) const;
    [[nodiscard]] bool is_unbounded(Id id) const {
        return !is_triangle(id) && fragment(id) == nullptr;
    }
    /// Counter-clockwise seen from above the source's support. \pre not unbounded.
    [[nodiscard]] std::vector<Point> corners(Id id) const;
    /// The same in doubles, of what is no triangle.
    [[nodiscard]] std::span<const Approximation> approximate_corners(Id id) const {
        const Fragment* const f = fragment(id);
        return f != nullptr ? f->vertices() : std::span<const Approximation>{};
    }
    /// Of its edges, in the order of its corners; none of what is a whole facet.
    [[nodiscard]] std::span<const EdgeName> edge_names(Id id) const {
        if (is_triangle(id) || fragment(id) == nullptr) return {};
        return fragment(id)->edges();
    }
    /// Contains the polygon, in lattice units; of triangles, no more.
    [[nodiscard]] DoubleBox bounds(Id id) const {
        return is_triangle(id) ? triangle_bounds(id) : bounds(box_of(id));
    }
    /// Contains all polygons, of unbounded ones what is in the cell.
    [[nodiscard]] DoubleBox bounds() const { return bounds(box_); }
    /// What lies at these positions.
    [[nodiscard]] DoubleBox bounds(const Box& box) const;

    [[nodiscard]] FacetName name(Id id) const { return {source(id).serial(), facet(id)}; }
    [[nodiscard]] FaceSource face_source(Id id) const;
    [[nodiscard]] std::size_t bytes() const;

private:
    struct Record {
        const Source* source = nullptr;
        std::uint32_t facet = 0;
        std::uint32_t fragment : 30 = triangle;  // of fragments_
        std::uint32_t flipped : 1 = 0;
        std::uint32_t reaches_out : 1 = 0;
    };
    static constexpr std::uint32_t triangle = (1U << 30U) - 1;

    [[nodiscard]] DoubleBox triangle_bounds(Id id) const;
    // Of what is no whole triangle. Its leaf keeps it; null for a whole plane.
    [[nodiscard]] const Fragment* fragment(Id id) const {
        return fragments_[records_[id].fragment];
    }
    [[nodiscard]] Box box_of(Id id) const {
        const bool is_whole = is_triangle(id) || fragment(id) == nullptr;
        return is_whole ? source(id).facet_box(facet(id)) : fragment(id)->box();
    }
    void add(const PolygonRef& ref);

    const Source* only_ = nullptr;
    bool whole_ = true;
    std::uint32_t size_ = 0;
    std::vector<Record> records_;
    std::vector<const Fragment*> fragments_;
    Cell cell_;
    Box box_;
};

inline DoubleBox IndexPolygons::triangle_bounds(Id id) const {
    const Source& s = source(id);
    const std::uint32_t f = facet(id);
    const auto a = s.corner(f, 0).doubles();
    const auto b = s.corner(f, 1).doubles();
    const auto c = s.corner(f, 2).doubles();
    DoubleBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.lo[k] = std::min(std::min(a[k], b[k]), c[k]);
        out.hi[k] = std::max(std::max(a[k], b[k]), c[k]);
    }
    return out;
}

}  // namespace trisect::detail
