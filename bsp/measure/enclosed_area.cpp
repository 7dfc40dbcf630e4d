// SPDX-License-Identifier: Apache-2.0
//
// A facet's area is the length of its vector area, which is a sum over its edges. Facets that pass
// through are read where they lie; the others take their edges as assembly gathers them.

#include <trisect/bsp/measure/enclosed_area.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/assembly/assembly_parts.h>
#include <trisect/bsp/measure/area_sum.h>
#include <trisect/bsp/measure/split_vertices.h>
#include <trisect/bsp/measure/vector_area.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// What is known of the area before it is summed up.
enum class AreaKind { Irrational, OfFacetsAcrossAxes, Unknown };

// Areas in one plane are rational multiples of each other. Half-spaces are not looked at.
bool has_rational_area(const BoundaryFacet& facet) {
    if (facet.source->is_half_space()) return true;
    LatticeMesh triangle;
    for (int i = 0; i < 3; ++i) triangle.points.push_back(facet.source->corner(facet.facet, i));
    triangle.triangles.push_back({0, 1, 2});
    return area(triangle).exact.has_value();
}

// A sum of positive roots of which one is irrational is so, too. What facets in special position
// have may have no width, and then no area: they do not make it irrational here.
AreaKind kind_of(const BoundaryParts& parts) {
    AreaKind kind = AreaKind::OfFacetsAcrossAxes;
    const auto look_at = [&](const BoundaryFacet& facet) {
        if (axis_across(facet) >= 0) return;
        const bool may_be_rational = facet.is_special || has_rational_area(facet);
        kind = may_be_rational ? AreaKind::Unknown : AreaKind::Irrational;
    };
    for (const FacetMarks& marks : parts.sources)
        marks.for_each_whole([&](std::uint32_t facet, bool) {
            if (kind != AreaKind::Irrational) look_at({marks.source(), facet});
        });
    for (const BoundaryEdge& e : parts.edges) {
        if (kind == AreaKind::Irrational) break;
        look_at(parts.facets[as_index(e.facet)]);
    }
    return kind;
}

class BoundaryArea {
public:
    BoundaryArea(const BoundaryParts& parts, const SplitUnits& units, const SplitVertices& vertices)
        : parts_(parts), units_(units), vertices_(vertices), slack_(0x1p-48 + vertices.error()) {}

    void add_whole_facets(const FacetMarks& marks) {
        const LatticeMesh& mesh = marks.source()->mesh();
        const bool is_held = units_.holds(marks.source()->fraction_bits());
        std::size_t since_check = 0;
        marks.for_each_whole([&](std::uint32_t facet, bool) {
            if (++since_check % 65536 == 0) check_stop();
            const auto& t = mesh.triangles[facet];
            const LatticePoint& a = mesh.points[t[0]];
            const LatticePoint& b = mesh.points[t[1]];
            const LatticePoint& c = mesh.points[t[2]];
            VectorArea area;
            if (is_held) {
                area.add(units_.whole(a), units_.whole(b), units_.whole(c));
            } else {
                area.add(units_.split(a), units_.split(b), units_.split(c), slack_);
            }
            add(area);
        });
    }

    /// The facets of a plane across an axis may share what bounds them (axis_faces.h): their areas
    /// are components of vectors about an axis and add up edge by edge.
    void add_cut_facets() {
        struct Fan {
            PointId apex = -1;
            int axis = -1;
            bool is_up = true;       // along the axis
            std::size_t number = 0;  // of its area, without an axis
        };
        PoolVector<Fan> fans(parts_.facets.size());
        PoolVector<VectorArea> areas;
        for (const BoundaryEdge& e : parts_.edges) {
            Fan& fan = fans[as_index(e.facet)];
            if (fan.apex < 0) {
                const BoundaryFacet& f = parts_.facets[as_index(e.facet)];
                fan = {e.from, axis_across(f), true, areas.size()};
                if (fan.axis < 0) {
                    areas.emplace_back();
                } else {
                    const Plane support = f.source->support(f.facet);
                    fan.is_up = support.normal(fan.axis).is_negative() == f.flipped;
                }
            }
            if (fan.axis >= 0) {
                add_across(e, static_cast<std::size_t>(fan.axis), fan.is_up);
            } else if (fan.apex != e.from && fan.apex != e.to) {
                areas[fan.number].add(vertices_[fan.apex], vertices_[e.from], vertices_[e.to],
                                      slack_);
            }
        }
        for (std::size_t f = 0; f < fans.size(); ++f) {
            if (fans[f].apex < 0 || fans[f].axis >= 0) continue;
            const VectorArea& area = areas[fans[f].number];
            add(area);
            if (!is_irrational_ && area.is_surely_not_0())
                is_irrational_ = !has_rational_area(parts_.facets[f]);
        }
    }
    /// Whether a facet that was cut has an irrational area.
    [[nodiscard]] bool is_irrational() const { return is_irrational_; }

    [[nodiscard]] EnclosedArea result(Lattice lattice) const {
        const ExactRational middle = ExactRational::from_double(sum_.sum().high) +
                                     ExactRational::from_double(sum_.sum().low) +
                                     ExactRational(WideInt<4>(across_[0])) +
                                     ExactRational(WideInt<4>(across_[1])).scaled(64);
        const ExactRational error = ExactRational::from_double(1.001 * (sum_.error() + error_));
        const int scale = 2 * (lattice.exponent - units_.shift()) - 1;
        return {(middle - error).scaled(scale), (middle + error).scaled(scale)};
    }

private:
    // Those across axes have one component, which is exact where corners have no rests.
    void add(const VectorArea& area) {
        std::array<Int128, 3> at{area.at(0), area.at(1), area.at(2)};
        const auto zeros = std::ranges::count(at, Int128{0});
        if (zeros < 2 || area.error() != 0) {
            sum_.add(at, area.error());
            return;
        }
        for (const Int128 a : at) add_across(a < 0 ? -a : a);
    }
    void add_across(Int128 part) {
        across_[0] += static_cast<std::uint64_t>(part);
        across_[1] += part >> 64;
    }

    // Seen from outside the facet is to the left of the edge.
    void add_across(const BoundaryEdge& e, std::size_t axis, bool is_up) {
        SplitPoint from = vertices_[e.from];
        SplitPoint to = vertices_[e.to];
        for (SplitPoint* const p : {&from, &to}) {
            p->whole[axis] = units_.centre()[axis];
            p->rest[axis] = 0;
        }
        VectorArea area;
        area.add({units_.centre(), {}}, from, to, slack_);
        add_across(is_up ? area.at(axis) : -area.at(axis));
        error_ += area.error();
    }

    const BoundaryParts& parts_;
    const SplitUnits& units_;
    const SplitVertices& vertices_;
    double slack_;
    AreaSum sum_;                     // doubled areas
    std::array<Int128, 2> across_{};  // of facets across axes: across_[0] + 2^64 across_[1]
    double error_ = 0;                // of those
    bool is_irrational_ = false;
};

}  // namespace

std::optional<EnclosedArea> enclosed_area(const SolidState& solid) {
    BoundaryParts parts;
    gather_parts(solid, parts, true);
    const AreaKind kind = kind_of(parts);
    const SplitUnits units = units_of(parts);
    SplitVertices vertices(parts, units);
    vertices.make(parts.edges);
    BoundaryArea area(parts, units, vertices);
    for (const FacetMarks& marks : parts.sources)
        if (!marks.source()->is_half_space()) area.add_whole_facets(marks);
    area.add_cut_facets();
    const EnclosedArea result = area.result(solid.lattice);
    if (kind == AreaKind::Irrational || area.is_irrational()) return result;
    const bool is_exact = kind == AreaKind::OfFacetsAcrossAxes && result.least == result.most;
    return is_exact ? std::optional(result) : std::nullopt;
}

}  // namespace trisect::detail
