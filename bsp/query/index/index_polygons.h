// SPDX-License-Identifier: Apache-2.0
//
// IndexPolygons: the polygons of a boundary under consecutive numbers.
// Planes, corners and names of the polygons are here.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/query/index/double_box.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

/// Facets and fragments of the boundary.
///
/// The number of a facet of a mesh that nothing has happened to is its own: then there is no table
/// at all. Otherwise a polygon takes 16 bytes, and what is not a whole triangle the planes of its
/// edges (240 bytes each).
///
/// Invariant: every polygon is closed, convex and has area; together they are the boundary, each
/// point of it in the interior of one polygon except where polygons end. The sources must outlive
/// the table.
class IndexPolygons {
public:
    using Id = std::uint32_t;

    IndexPolygons() = default;
    /// All facets of one source, unturned.
    explicit IndexPolygons(const Source& source);

    static constexpr Id none = 0xffffffffU;

    // Made in two passes over the leaves. A leaf may list facets that only pass by its cell, and a
    // facet that is listed whole in one cell may be cut in another one: then what is of it in each
    // cell counts. So facets are looked at in all cells before they are numbered.

    /// First pass: every polygon of every leaf.
    void note(const PolygonRef& ref, bool turned, const Cell& cell, bool incomplete);
    /// Second pass: numbers a polygon of a leaf; the same number again for the same whole facet.
    /// `none` for what is no part of the boundary.
    Id add(const PolygonRef& ref, bool turned, const Cell& cell);
    /// Forgets what only `add` needs.
    void finish();

    [[nodiscard]] std::uint32_t size() const { return size_; }
    /// Whether all sources are whole, those of edges included.
    [[nodiscard]] bool is_whole() const { return whole_; }
    /// No table: polygon i is facet i of the one source.
    [[nodiscard]] const Source* only_source() const { return only_; }

    [[nodiscard]] bool is_triangle(Id id) const {
        return only_ != nullptr || records_[id].kind == Kind::Triangle;
    }
    [[nodiscard]] const Source& source(Id id) const {
        return only_ != nullptr ? *only_ : *sources_[records_[id].source];
    }
    [[nodiscard]] std::uint32_t facet(Id id) const {
        return only_ != nullptr ? id : records_[id].facet;
    }
    /// Whether outside is below the support of the source's facet.
    [[nodiscard]] bool is_flipped(Id id) const { return only_ == nullptr && records_[id].flipped; }
    /// Corner i of the source's triangle, whether or not the polygon is all of it.
    [[nodiscard]] const LatticePoint& corner(Id id, int i) const {
        return source(id).corner(facet(id), i);
    }
    /// The support as the source has it.
    [[nodiscard]] Plane support(Id id) const {
        return is_triangle(id) ? source(id).support(facet(id)) : planes_[records_[id].first];
    }
    /// Its normal outward.
    [[nodiscard]] Plane outward(Id id) const {
        const Plane p = support(id);
        return is_flipped(id) ? p.flipped() : p;
    }
    /// The planes of the edges, below which a polygon that is no triangle lies. None for a facet
    /// that is a whole plane.
    [[nodiscard]] std::span<const Plane> edges(Id id) const {
        const Record& r = records_[id];
        return std::span(planes_).subspan(std::size_t{r.first} + 1, r.edges);
    }
    /// The same, made for triangles too; `storage` holds them.
    [[nodiscard]] std::span<const Plane> edges(Id id, std::array<Plane, 3>& storage) const;
    [[nodiscard]] bool is_unbounded(Id id) const {
        return !is_triangle(id) && records_[id].edges == 0;
    }
    /// Counter-clockwise seen from above the source's support. \pre not unbounded.
    [[nodiscard]] std::vector<Point> corners(Id id) const;
    /// Contains the polygon, in lattice units; of triangles, no more.
    [[nodiscard]] DoubleBox bounds(Id id) const {
        return is_triangle(id) ? triangle_bounds(id) : bounds(boxes_[records_[id].box]);
    }
    /// What lies at these positions.
    [[nodiscard]] DoubleBox bounds(const Box& box) const;

    [[nodiscard]] FacetName name(Id id) const { return {source(id).serial(), facet(id)}; }
    [[nodiscard]] FaceSource face_source(Id id) const;
    [[nodiscard]] std::size_t bytes() const;

private:
    enum class Kind : std::uint8_t { Triangle, Convex };
    struct Record {
        std::uint32_t source = 0;
        std::uint32_t facet = 0;
        std::uint32_t first = 0;  // of planes_: support, then edges
        std::uint32_t box = 0;
        std::uint16_t edges = 0;
        Kind kind = Kind::Triangle;
        bool flipped = false;
    };

    // What is known of a facet, turned or not, while polygons are added.
    struct Facet {
        Id id = none;
        bool owned = false;  // listed whole where its first corner is
        bool cut = false;    // or touched or incomplete: not the same in all cells
    };

    [[nodiscard]] DoubleBox triangle_bounds(Id id) const;
    std::uint32_t slot_of(const Source* source);
    [[nodiscard]] Facet& facet_at(std::uint32_t slot, std::uint32_t facet, bool flipped);
    Id add_clipped(const PolygonRef& ref, bool flipped, std::uint32_t slot, const Cell& cell);
    Id add_convex(const PolygonRef& ref, bool flipped, std::uint32_t slot,
                  std::span<const Plane> edges, const Box& box);

    const Source* only_ = nullptr;
    bool whole_ = true;
    std::uint32_t size_ = 0;
    std::vector<const Source*> sources_;
    std::vector<Record> records_;
    std::vector<Plane> planes_;
    std::vector<Box> boxes_;
    std::vector<std::vector<Facet>> facets_;  // by source: two for each facet, unturned and flipped
    std::unordered_map<const Source*, std::uint32_t> slots_;
    std::uint32_t last_slot_ = 0;
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
