// SPDX-License-Identifier: Apache-2.0
//
// In a mixed cell the point's sides of the planes there decide first: points above all planes, or
// below all, are in a convex region without polygons, and what such a region is, is known.
// Otherwise the segment to a corner of the cell is traced across the polygons whose planes separate
// the two, and that corner is taken which fewest planes separate from the point. All this is one
// pass over numbers of a few hundred bytes that lie side by side. Looking up corners of the mesh
// instead takes a dozen lines of memory for ten polygons, and that, not arithmetic, is what it
// would cost.
//
// Where a sign is not sure the polygon is tested exactly. A point can be on a polygon only when its
// side of the plane is not sure and the line through it along the normal does not surely pass by
// the triangle.

#include <trisect/bsp/query/points/index_in_leaf.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/query/index/index_regions.h>
#include <trisect/bsp/query/index/index_signs.h>
#include <trisect/bsp/query/index/index_windings.h>
#include <trisect/kernel/counters.h>

namespace trisect::detail {

namespace {

using Answer = PointInLeaf::Answer;

// A sign that a leaf's planes did not decide.
constexpr int unsure_sign = 2;

int sure_sign(float v) {
    return v > LeafPlanes::unsure ? 1 : (v < -LeafPlanes::unsure ? -1 : unsure_sign);
}

Answer answer(bool inside) { return inside ? Answer::Inside : Answer::Outside; }

unsigned lowest(std::uint64_t bits) { return static_cast<unsigned>(std::countr_zero(bits)); }

// The place of a point in a cell's coordinates; false when it is not near.
bool find_place(const IndexedLeaf::Cell& cell, const IndexGrid::Position& at,
                std::array<float, 3>& place) {
    const double scale = 1 / static_cast<double>(std::uint32_t{1} << cell.shift);
    bool fits = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto low = static_cast<double>(at.fine[k] >> cell.shift << cell.shift);
        const double v = (at.at[k] - low) * scale;
        fits = fits && v > -0.25 && v < 1.25;
        place[k] = static_cast<float>(v);
    }
    return fits;
}

// A corner's sides of planes.
PlaneSides sides_of_corner(const LeafPlanes& planes, std::uint32_t count, unsigned corner) {
    return sides_of(planes, count,
                    {static_cast<float>(corner & 1U), static_cast<float>(corner >> 1U & 1U),
                     static_cast<float>(corner >> 2U)});
}

}  // namespace

void PointInLeaf::begin(const IndexedLeaf& index, bool turned, const IndexedLeaf::Cell& cell,
                        const IndexGrid::Position& at, bool precise) {
    index_ = &index;
    turned_ = turned;
    leaf_ = &index.leaf(cell.leaf);
    cell_ = cell;
    at_ = at;
    near_ = 0;
    unsure_ = 0;
    on_ = 0;
    kind_ = Kind::List;
    if (!precise || !leaf_->has_planes() || !find_place(cell, at, place_)) return;
    kind_ = leaf_->count <= LeafPlanes::most ? Kind::Few : Kind::Many;
}

Answer PointInLeaf::decide() {
    if (kind_ != Kind::Few) return Answer::Open;
    const PlaneSides sides = sides_of(index_->planes(*leaf_), leaf_->count, place_);
    detail::counters_of_thread<PredicateCounters>.filtered += leaf_->count;
    above_ = sides.above;
    below_ = sides.below;
    all_ = ~std::uint64_t{0} >> (64 - leaf_->count);
    const std::uint8_t common = above_ == all_   ? leaf_->above
                                : below_ == all_ ? leaf_->below
                                                 : IndexLeaf::unknown;
    if (common != IndexLeaf::unknown) {
        ++index_counters().side;
        return answer(common != 0);
    }
    const std::uint64_t open = all_ & ~(above_ | below_);
    if (const auto known = open == 0 ? remembered(*leaf_, above_) : std::nullopt) {
        ++index_counters().region;
        return answer(*known);
    }
    near_ = narrowed(open);
    return near_ != 0 ? Answer::Open : trace();
}

// Without polygons beside which the point surely is.
std::uint64_t PointInLeaf::narrowed(std::uint64_t open) const {
    if (open == 0 || !leaf_->has_corners()) return open;
    const LeafPlanes planes = index_->planes(*leaf_);
    std::uint64_t out = 0;
    LeafLine line(leaf_->step, place_);
    const float* corners = index_->corners(*leaf_);
    for (; open != 0; open &= open - 1) {
        const unsigned i = lowest(open);
        line.aim_along(planes, i);
        if (line.at(corners, i) != LineSide::Beside) out |= std::uint64_t{1} << i;
    }
    return out;
}

// For a point on no polygon.
Answer PointInLeaf::trace() {
    const LeafPlanes planes = index_->planes(*leaf_);
    const std::array<std::uint8_t, 8> together = planes_together(planes, place_);
    corner_ = no_corner;
    int most = -1;
    for (unsigned c = 0; c < 8; ++c) {
        if ((leaf_->known >> c & 1U) == 0 || together[c] <= most) continue;
        most = together[c];
        corner_ = c;
    }
    unsure_ = all_;
    if (corner_ == no_corner) return Answer::Open;
    winding_ = leaf_->inside >> corner_ & 1;
    const PlaneSides of_corner = sides_of_corner(planes, leaf_->count, corner_);
    const std::uint64_t apart = all_ & ~((above_ & of_corner.above) | (below_ & of_corner.below));
    if (apart == 0) {
        ++index_counters().corner;
        return answer(winding_ > 0);
    }
    unsure_ = apart;
    opposite_ = (above_ & of_corner.below) | (below_ & of_corner.above);
    if (!leaf_->has_corners()) return Answer::Open;
    unsure_ = 0;
    const float* corners = index_->corners(*leaf_);
    LeafLine line(leaf_->step, place_);
    line.aim_at_corner(corner_);
    for (std::uint64_t left = apart; left != 0; left &= left - 1) {
        const unsigned i = lowest(left);
        const std::uint64_t bit = left & ~(left - 1);
        const LineSide side = line.at(corners, i);
        if (side == LineSide::Beside) continue;
        if (side == LineSide::Unsure || (opposite_ & bit) == 0) {
            unsure_ |= bit;
        } else {
            winding_ += (below_ & bit) != 0 ? 1 : -1;
        }
    }
    detail::counters_of_thread<PredicateCounters>.filtered +=
        static_cast<std::uint64_t>(std::popcount(apart));
    if (unsure_ != 0) return Answer::Open;
    ++index_counters().traced;
    return answer(winding_ > 0);
}

// The change of the winding number at a polygon on the way to the reference.
int PointInLeaf::passed(Id id, const IndexPoint& p, const Reference& reference,
                        std::vector<PolygonId>& on) const {
    const Passing s = passing(index_->polygons(), id, p, reference);
    if (s == Passing::On) {
        on.push_back({index_, id, turned_});
        return 0;
    }
    return index_->polygons().is_flipped(id) ? -static_cast<int>(s) : static_cast<int>(s);
}

FinePoint PointInLeaf::corner_point() const {
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = (at_.fine[k] >> cell_.shift) + (corner_ >> k & 1U);
        p.c[k] = fine_position(cell_.grid->splitter(k, i << cell_.shift));
    }
    return p;
}

bool PointInLeaf::finish(const IndexPoint& p, std::vector<PolygonId>& on) {
    if (kind_ == Kind::List) return trace_to_reference(p, on);
    if (kind_ == Kind::Many) return finish_many(p, on);
    const auto listed = index_->listed(*leaf_);
    if (near_ != 0) {
        for (; near_ != 0; near_ &= near_ - 1) {
            const unsigned i = lowest(near_);
            if (!is_on(index_->polygons(), listed[i], p)) continue;
            on.push_back({index_, listed[i], turned_});
            on_ |= std::uint64_t{1} << i;
        }
        if (on_ != 0) {
            ++index_counters().on;
            return false;
        }
        const Answer found = trace();
        if (found != Answer::Open) return found == Answer::Inside;
    }
    if (corner_ == no_corner) return trace_to_reference(p, on);
    ++index_counters().exact;
    winding_ += winding_past(unsure_, p, on);
    if ((above_ | below_) == all_) remember(*leaf_, above_, winding_ > 0);
    return winding_ > 0;
}

// The change of the winding number at some polygons on the way to the corner. Fragments have no
// corners in the leaf; how the line runs past theirs in doubles takes a fraction of what exact
// planes of support and edges would.
int PointInLeaf::winding_past(std::uint64_t polygons, const IndexPoint& p,
                              std::vector<PolygonId>& on) const {
    const auto listed = index_->listed(*leaf_);
    const Reference reference(corner_point());
    const LineThrough line = line_between(p, reference);
    int winding = 0;
    for (; polygons != 0; polygons &= polygons - 1) {
        const unsigned i = lowest(polygons);
        const std::uint64_t bit = polygons & ~(polygons - 1);
        const Id id = listed[i];
        const int through = index_->polygons().is_triangle(id)
                                ? 0
                                : line.of(index_->polygons().approximate_corners(id));
        if (through < 0) continue;
        if (through > 0 && (opposite_ & bit) != 0) {
            winding += (below_ & bit) != 0 ? 1 : -1;
        } else {
            winding += passed(id, p, reference, on);
        }
    }
    return winding;
}

// The same plane by plane.
bool PointInLeaf::finish_many(const IndexPoint& p, std::vector<PolygonId>& on) {
    const std::size_t before = on.size();
    const LeafPlanes planes = index_->planes(*leaf_);
    const auto listed = index_->listed(*leaf_);
    detail::counters_of_thread<PredicateCounters>.filtered += leaf_->count;
    const auto at_corner = [&](std::uint32_t i, unsigned c) {
        return planes.at(i, {static_cast<float>(c & 1U), static_cast<float>(c >> 1U & 1U),
                             static_cast<float>(c >> 2U)});
    };
    std::array<std::uint32_t, 8> together{};
    for (std::uint32_t i = 0; i < leaf_->count; ++i) {
        const int sign = sure_sign(planes.at(i, place_));
        if (sign == unsure_sign) {
            if (is_on(index_->polygons(), listed[i], p)) on.push_back({index_, listed[i], turned_});
            continue;
        }
        for (unsigned c = 0; c < 8; ++c)
            together[c] += sure_sign(at_corner(i, c)) == sign ? 1U : 0U;
    }
    if (on.size() != before) {
        ++index_counters().on;
        return false;
    }
    corner_ = no_corner;
    for (unsigned c = 0; c < 8; ++c)
        if ((leaf_->known >> c & 1U) != 0 &&
            (corner_ == no_corner || together[c] > together[corner_]))
            corner_ = c;
    if (corner_ == no_corner) return trace_to_reference(p, on);
    winding_ = leaf_->inside >> corner_ & 1;
    ++index_counters().exact;
    const Reference reference(corner_point());
    for (std::uint32_t i = 0; i < leaf_->count; ++i) {
        const int sign = sure_sign(planes.at(i, place_));
        if (sign != unsure_sign && sign == sure_sign(at_corner(i, corner_))) continue;
        winding_ += passed(listed[i], p, reference, on);
    }
    return winding_ > 0;
}

bool PointInLeaf::trace_to_reference(const IndexPoint& p, std::vector<PolygonId>& on) const {
    const std::size_t before = on.size();
    int winding = leaf_->winding;
    const Reference reference(index_->reference(cell_, at_));
    for (const Id id : index_->listed(*leaf_)) winding += passed(id, p, reference, on);
    ++(on.size() == before ? index_counters().exact : index_counters().on);
    return winding > 0;
}

// Components of a cross product of two normals err by less than 2^-18, a determinant of three by
// less than 2^-15.
int PointInLeaf::rank() const {
    if (on_ == 0) return 0;
    if ((on_ & (on_ - 1)) == 0) return 1;
    const LeafPlanes planes = index_->planes(*leaf_);
    const auto normal = [&](unsigned i) {
        const float* f = planes.first + i;
        return std::array<float, 3>{f[0], f[planes.stride], f[2 * planes.stride]};
    };
    const auto first = normal(lowest(on_));
    std::array<float, 3> both{};
    bool turned = false;
    std::uint64_t left = on_ & (on_ - 1);
    for (; left != 0; left &= left - 1) {
        const auto n = normal(lowest(left));
        if (turned) {
            if (std::fabs(both[0] * n[0] + both[1] * n[1] + both[2] * n[2]) > 0x1p-14F) return 3;
            continue;
        }
        both = {first[1] * n[2] - first[2] * n[1], first[2] * n[0] - first[0] * n[2],
                first[0] * n[1] - first[1] * n[0]};
        turned = std::max({std::fabs(both[0]), std::fabs(both[1]), std::fabs(both[2])}) > 0x1p-17F;
    }
    const std::uint64_t others = on_ & (on_ - 1);
    return turned && (others & (others - 1)) == 0 ? 2 : 0;
}

}  // namespace trisect::detail
