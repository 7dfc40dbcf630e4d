// SPDX-License-Identifier: Apache-2.0
//
// Division of a convex part by a line: that of a contact, or a bounding plane of the cell.
//
// A contact's line divides a part only where the contact's segment has more than a point in common
// with the part. Vertices with sign 0 are on the line by name and become ends of the cut; between
// two vertices on different sides a new one is made.

#include <trisect/bsp/leaf/doubles/filtered_cutting.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/plane.h>

namespace trisect::detail {

// Both parts of a part whose vertices have these signs with respect to a line's plane. `cuts`: the
// new vertices in the order in which a walk around the part comes to them.
void FilteredCutting::divide(const FilteredPart& from, FilteredLine line, const Signs& signs,
                             const std::array<std::int16_t, 2>& cuts, FilteredPart& below,
                             FilteredPart& above) const {
    below.size = above.size = 0;
    below.above = above.above = 0;
    std::size_t cut = 0;
    for (std::size_t i = 0; i < from.size; ++i) {
        const int here = signs[i];
        const int next = signs[i + 1 < from.size ? i + 1 : 0];
        const std::int16_t v = from.vertices[i];
        const FilteredLine e = from.lines[i];
        const bool side = (from.above >> i & 1U) != 0;
        if (here < 0) below.add(v, e, side);
        if (here > 0) above.add(v, e, side);
        if (here == 0 && next < 0) {
            below.add(v, e, side);
            above.add(v, line, true);
        } else if (here == 0) {
            above.add(v, e, side);
            below.add(v, line, false);
        } else if (here * next < 0) {
            const std::int16_t x = cuts[cut++];
            if (next < 0) {
                below.add(x, e, side);
                above.add(x, line, true);
            } else {
                above.add(x, e, side);
                below.add(x, line, false);
            }
        }
    }
}

// Whether the part was cut before along the contact's line by a facet of another plane.
bool FilteredCutting::runs_along(const FilteredPart& part, const Signs& signs,
                                 std::size_t contact) const {
    const auto support = [&](std::size_t c) {
        const PolygonRef& ref = (*facets_)[contacts_[c].other].ref;
        return ref.source->support(ref.facet);
    };
    for (std::size_t i = 0; i < part.size; ++i) {
        const FilteredLine line = part.lines[i];
        if (signs[i] != 0 || signs[i + 1 < part.size ? i + 1 : 0] != 0) continue;
        if (line >= first_contact_line && line != line_of(contact) &&
            !is_same_plane(support(static_cast<std::size_t>(line - first_contact_line)),
                           support(contact)))
            return true;
    }
    return false;
}

FilteredCutting::Split FilteredCutting::split(std::size_t part, std::size_t contact, bool sure) {
    const FilteredPart from = parts_[part];
    Signs signs;
    bool below = false;
    bool above = false;
    for (std::size_t i = 0; i < from.size; ++i) {
        const int s = sign_at(from.vertices[i], contact);
        signs[i] = static_cast<std::int8_t>(s);
        below = below || s < 0;
        above = above || s > 0;
    }
    if (!below || !above) {
        if (keeps_common_lines_ && !is_common_line_)
            is_common_line_ = runs_along(from, signs, contact);
        return Split::Missed;
    }
    if (from.size + 2U > FilteredPart::max_size) return Split::Uncertain;
    // Where the line enters the part and where it leaves it, in its direction.
    const FilteredPlane& plane = facets_->plane(contacts_[contact].other);
    std::array<std::int16_t, 2> ends{-1, -1};
    std::array<std::int16_t, 2> cuts{};
    std::size_t made = 0;
    for (std::size_t i = 0; i < from.size; ++i) {
        const std::size_t next = i + 1 < from.size ? i + 1 : 0;
        if (signs[i] != 0 && signs[i] * signs[next] >= 0) continue;
        std::int16_t& end = ends[signs[next] > 0 ? 0 : 1];
        if (end >= 0 || signs[next] == 0) return Split::Uncertain;
        if (signs[i] == 0) {
            end = from.vertices[i];
            continue;
        }
        const Approximation u = vertices_[static_cast<std::size_t>(from.vertices[i])].at;
        const Approximation w = vertices_[static_cast<std::size_t>(from.vertices[next])].at;
        FilteredVertex x;
        x.lines = {from.lines[i], line_of(contact)};
        if (!interpolate(u, plane.value(u.c), w, plane.value(w.c), plane.error(u) + plane.error(w),
                         x.at))
            x.at = exact_point(x.lines);
        name_pierced_edge(x);
        cuts[made++] = end = static_cast<std::int16_t>(vertices_.size());
        vertices_.push_back(x);
    }
    if (ends[0] < 0 || ends[1] < 0) return Split::Uncertain;
    if (!sure) {
        // Does the segment have more than a point in common with what of the line is in the part?
        const LineDirection direction = direction_of(contact);
        if (!is_inside_end(ends[0], contact, true, direction) ||
            !is_inside_end(ends[1], contact, false, direction))
            return Split::Missed;
    }
    FilteredPart& upper = add_part();
    FilteredPart& lower = parts_[part];
    std::copy_n(sides_.begin() + static_cast<std::ptrdiff_t>(from.sides), 2 * row_,
                sides_.begin() + static_cast<std::ptrdiff_t>(upper.sides));
    divide(from, line_of(contact), signs, cuts, lower, upper);
    // Both are beside the segment, so the cutter's own solid is on one side of it.
    const bool upright = (*facets_)[contacts_[contact].other].orientation > 0;
    upper.winding = upright ? 0 : 1;
    lower.winding = upright ? 1 : 0;
    return Split::Done;
}

bool FilteredCutting::clip_at(std::size_t axis, bool high) {
    const double splitter = high ? facets_->splitter_hi()[axis] : facets_->splitter_lo()[axis];
    const FilteredPart from = clipped_;
    if (from.size + 2U > FilteredPart::max_size) return false;
    const auto point = [&](std::size_t i) -> const Approximation& {
        return vertices_[static_cast<std::size_t>(from.vertices[i])].at;
    };
    const auto error = [&](const Approximation& a) {
        return a.error + 0x1p-51 * (std::fabs(a.c[axis]) + std::fabs(splitter)) +
               facets_->splitter_error();
    };
    Signs signs;
    bool below = false;
    bool above = false;
    for (std::size_t i = 0; i < from.size; ++i) {
        int s = 0;
        if (facets_->is_whole() && from.vertices[i] < (*facets_)[item_].size &&
            point(i).error == 0) {
            // A lattice position, and the last one below the splitting plane is exact too.
            const double c = point(i).c[axis];
            s = (high ? c > facets_->inner_hi()[axis] : c >= facets_->inner_lo()[axis]) ? 1 : -1;
        } else {
            const double gap = point(i).c[axis] - splitter;
            if (std::fabs(gap) <= error(point(i))) return false;
            s = gap > 0 ? 1 : -1;
        }
        signs[i] = static_cast<std::int8_t>(s);
        below = below || s < 0;
        above = above || s > 0;
    }
    if (!(high ? above : below)) return true;  // nothing is beyond the splitting plane
    was_clipped_ = true;
    if (!(high ? below : above)) {
        clipped_.size = 0;
        return true;
    }
    const auto line = static_cast<FilteredLine>(first_splitter_line + 2 * static_cast<int>(axis) +
                                                static_cast<int>(high));
    std::array<std::int16_t, 2> cuts{};
    std::size_t made = 0;
    for (std::size_t i = 0; i < from.size; ++i) {
        const std::size_t next = i + 1 < from.size ? i + 1 : 0;
        if (signs[i] == signs[next]) continue;
        if (made == 2) return false;
        FilteredVertex x;
        if (!interpolate(point(i), point(i).c[axis] - splitter, point(next),
                         point(next).c[axis] - splitter, error(point(i)) + error(point(next)),
                         x.at))
            return false;
        x.lines = {from.lines[i], line};
        cuts[made++] = static_cast<std::int16_t>(vertices_.size());
        vertices_.push_back(x);
    }
    FilteredPart rest;
    divide(from, line, signs, cuts, high ? clipped_ : rest, high ? rest : clipped_);
    return true;
}

bool FilteredCutting::clip_to_cell() {
    const FilteredFacet& f = (*facets_)[item_];
    if (f.contained) return true;
    if (f.is_beyond) {
        clipped_.size = 0;
        return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const unsigned ends = f.splitters >> 2 * k;
        if (clipped_.size != 0 && f.lo[k] < facets_->inner_lo()[k] && (ends & 1U) == 0 &&
            !clip_at(k, false))
            return false;
        if (clipped_.size != 0 && f.hi[k] > facets_->inner_hi()[k] && (ends & 2U) == 0 &&
            !clip_at(k, true))
            return false;
    }
    return true;
}

}  // namespace trisect::detail
