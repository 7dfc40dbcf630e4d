// SPDX-License-Identifier: Apache-2.0
//
// A plate with ten thousand pockets is a few planes. What its leaves list are convex parts of its
// triangles, cut along bounding planes of cells, along the lines of all tools, and by the diagonals
// of the triangles. To give every corner of every part a name, to find the vertices that lie inside
// their sides, and to cancel what runs both ways costs microseconds a part; and nearly all of it is
// about places where in the end nothing is.
//
// Where all polygons of a cell are axis-perpendicular the slanted sides of those in one plane
// cancel: nothing else that bounds the solid there has a slanted side. The other sides lie at
// integers. So the outline of all that a plane has is a sum of integers (axis_outline.h), over all
// cells together, and splitting planes vanish with the rest.
//
// Facets that may come out as they went in are not taken: to_mesh copies them with their corners.
// Whether a facet has changed shows in its area, or in an outline that turns inside one of its
// edges. In doubt its plane is left to the general path.

#include <trisect/bsp/assembly/axis/axis_face_outlines.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/leaf/grid/axis_clip.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

template <class Number>
bool is_across_an_axis(const PolygonRef& r) {
    if (!AxisNumbers<Number>::takes(*r.source)) return false;
    const LatticePoint& a = r.source->corner(r.facet, 0);
    const LatticePoint& b = r.source->corner(r.facet, 1);
    const LatticePoint& c = r.source->corner(r.facet, 2);
    return (a.x == b.x && a.x == c.x) || (a.y == b.y && a.y == c.y) || (a.z == b.z && a.z == c.z);
}

template <class Number>
bool lies_in(const PolygonRef& r, const AxisPlane<Number>& plane) {
    if (!AxisNumbers<Number>::takes(*r.source)) return false;
    const auto axis = static_cast<int>(plane.axis);
    for (int i = 0; i < 3; ++i)
        if (axis_position<Number>(r.source->corner(r.facet, i)[axis]) != plane.position)
            return false;
    return true;
}

template <class Number>
bool all_across_axes(const PolygonList& polygons) {
    return std::all_of(polygons.begin(), polygons.end(), is_across_an_axis<Number>);
}

/// Keeps a fragment that no list holds.
class HeldFragment {
public:
    explicit HeldFragment(const Fragment* fragment) : fragment_(fragment) { fragment_->retain(); }
    HeldFragment(const HeldFragment&) = delete;
    HeldFragment& operator=(const HeldFragment&) = delete;
    ~HeldFragment() { fragment_->release(); }

private:
    const Fragment* fragment_;
};

template <class Number>
AxisRectangle<Number> rectangle_of(const Cell& cell, std::size_t across) {
    AxisRectangle<Number> out;
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t axis = (across + 1 + i) % 3;
        const auto side = [&](std::int64_t at, bool above) {
            return typename AxisRectangle<Number>::Side{
                AxisNumbers<Number>::from_fine(at),
                {PlaneName::splitter(static_cast<int>(axis), at), above}};
        };
        out.sides[i] = {side(cell.lo[axis], true), side(cell.hi[axis], false)};
    }
    return out;
}

bool reaches_out(const PolygonRef& r, const Cell& cell) {
    return r.fragment != nullptr ? !ends_at_splitters(*r.fragment, cell) : !cell.contains(r.box());
}

// Calls add(part) for what a polygon has in a cell, if that has area. False where integers do not
// decide.
template <class Number, class Add>
bool with_part_in(const PolygonRef& polygon, const Cell& cell, std::size_t across, const Add& add) {
    if (!reaches_out(polygon, cell)) {
        add(polygon);
        return true;
    }
    AxisPolygon<Number> shape;
    if (!shape.read(polygon) || shape.slanted_count > 1) return false;
    if (!shape.meets(AxisBox<Number>::of(cell))) return true;
    const auto part = clip_to_rectangle(shape, rectangle_of<Number>(cell, across));
    if (!part) return true;
    const HeldFragment held(part->fragment);
    add(*part);
    return true;
}

}  // namespace

template <class Number>
void AxisFaceOutlines<Number>::choose(std::span<const Leaf> leaves) {
    list_open_planes();
    if (open_count_ == 0) return;
    facets_.assign(parts_.facets.size(), {});
    across_.clear();
    is_alone_ = threads_ == 1 || ParallelParts(parts_.facets.size(), threads_).count() == 1;
    for (const Leaf& leaf : leaves) {
        across_.push_back(leaf.occupancy != nullptr || all_across_axes<Number>(*leaf.polygons));
        if (!across_.back()) continue;
        check_stop(1 + leaf.polygons->size());
        if (is_alone_) {
            read_leaf(leaf);
        } else {
            list_leaf(leaf);
        }
        ++read_count_;
        if (open_count_ != 0) continue;
        passing_ = {};
        return;
    }
    if (std::ranges::find(across_, true) == across_.end()) return;
    read_listed(leaves);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (across_[i]) continue;
        check_stop(1 + leaves[i].polygons->size());
        block_leaf(leaves[i]);
    }
    read_all_units();
    judge();
}

// Those that may be taken: a facet of them has changed, and none that passes through was met. In a
// chain few planes have changed facets, and leaves that nothing cuts show soon that all of them
// have others too.
template <class Number>
void AxisFaceOutlines<Number>::list_open_planes() {
    std::optional<Plane> last;
    for (const BoundaryFacet& f : parts_.facets) {
        if (f.source->is_half_space()) continue;
        const PolygonRef facet{f.source, nullptr, f.facet, false, false};
        if ((last && lies_in(facet, *last)) || !is_across_an_axis<Number>(facet)) continue;
        last = axis_plane<Number>(PlaneName::support(f.source, f.facet));
        if (open_planes_.insert(key_of(*last), 0).second) ++open_count_;
    }
}

template <class Number>
const FacetMarks& AxisFaceOutlines<Number>::marks_of(const Source* source) {
    if (source != last_source_) last_table_ = parts_.table_of(source);
    last_source_ = source;
    return parts_.sources[last_table_];
}

template <class Number>
auto AxisFaceOutlines<Number>::face_plane_at(const Plane& plane, const PlaneName& name)
    -> FacePlane& {
    const auto [id, inserted] =
        face_plane_ids_.insert(key_of(plane), static_cast<std::int32_t>(face_planes_.size()));
    if (inserted) {
        face_planes_.emplace_back();
        face_planes_.back().plane = plane;
        face_planes_.back().name = name;
    }
    return face_planes_[as_index(id)];
}

template <class Number>
void AxisFaceOutlines<Number>::read_leaf(const Leaf& leaf) {
    std::size_t i = 0;
    for (const PolygonRef r : *leaf.polygons) {
        const FacetMarks& marks = marks_of(r.source);
        const bool flipped = r.flipped != leaf.complemented;
        if (marks.takes_part(r.facet, flipped)) {
            const std::int32_t number = marks.number_of_worked(r.facet, flipped);
            (void)face_plane_of(r, number);
            read_in_leaf(r, number, leaf, i, sides_);
        } else if (marks.is_present(r.facet, flipped)) {
            pass(r);
        }
        ++i;
    }
    if (leaf.occupancy != nullptr) with_units_.push_back(&leaf);
}

// \pre the plane of its facet is listed
template <class Number>
void AxisFaceOutlines<Number>::read_in_leaf(const PolygonRef& polygon, std::int32_t number,
                                            const Leaf& leaf, std::size_t place,
                                            std::vector<Side>& sides) {
    if (leaf.occupancy != nullptr) {
        read_facet(polygon, number, leaf.occupancy->parts[place], leaf.cell);
    } else {
        read_polygon(polygon, number, leaf.cell, sides);
    }
}

// What several threads read later needs the planes, by number, and which of them pass.
template <class Number>
void AxisFaceOutlines<Number>::list_leaf(const Leaf& leaf) {
    for (const PolygonRef r : *leaf.polygons) {
        const FacetMarks& marks = marks_of(r.source);
        const bool flipped = r.flipped != leaf.complemented;
        if (marks.takes_part(r.facet, flipped)) {
            (void)face_plane_of(r, marks.number_of_worked(r.facet, flipped));
        } else if (marks.is_present(r.facet, flipped)) {
            pass(r);
        }
    }
    if (leaf.occupancy != nullptr) with_units_.push_back(&leaf);
}

// Each thread looks at all polygons, and reads those of its planes: what is kept of a polygon is
// of its plane and of its facet. So they come in the same order for any number of threads.
template <class Number>
void AxisFaceOutlines<Number>::read_listed(std::span<const Leaf> leaves) {
    if (is_alone_) return;
    const std::size_t count = parts_by_thread(face_planes_.size(), threads_, 1).count();
    const StopScope* const scope = stop_scope_of_thread;
    ParallelParts(count, count == 1 ? 1 : threads_, 1)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t part = begin; part < end; ++part)
                read_planes(leaves, part, count, scope);
        });
}

// Those of which the number leaves that rest.
template <class Number>
void AxisFaceOutlines<Number>::read_planes(std::span<const Leaf> leaves, std::size_t rest,
                                           std::size_t divisor, const StopScope* scope) {
    std::vector<Side> sides;
    const Source* last_source = nullptr;
    const FacetMarks* marks = nullptr;
    for (std::size_t l = 0; l < leaves.size(); ++l) {
        if (!across_[l]) continue;
        const Leaf& leaf = leaves[l];
        check_flags(scope);
        std::size_t i = 0;
        for (const PolygonRef r : *leaf.polygons) {
            if (r.source != last_source) marks = &parts_.sources[parts_.table_of(r.source)];
            last_source = r.source;
            const bool flipped = r.flipped != leaf.complemented;
            const std::size_t place = i++;
            if (!marks->takes_part(r.facet, flipped)) continue;
            const std::int32_t number = marks->number_of_worked(r.facet, flipped);
            if (as_index(facets_[as_index(number)].face_plane) % divisor == rest)
                read_in_leaf(r, number, leaf, place, sides);
        }
    }
}

// Its plane is not taken. Facets of one plane mostly come one after the other.
template <class Number>
void AxisFaceOutlines<Number>::pass(const PolygonRef& facet) {
    passing_.push_back({facet.source, facet.facet});
    if (last_passed_ && lies_in(facet, *last_passed_)) return;
    const PlaneName name = PlaneName::support(facet.source, facet.facet);
    last_passed_ = axis_plane<Number>(name);
    FacePlane& face_plane = face_plane_at(*last_passed_, name);
    if (!face_plane.has_passing && open_planes_.find(key_of(*last_passed_)) >= 0) --open_count_;
    face_plane.has_passing = face_plane.is_general = true;
}

// Its parts are in the occupancy grid's units. One that is not cut has all its area in the cell.
template <class Number>
void AxisFaceOutlines<Number>::read_facet(const PolygonRef& facet, std::int32_t number,
                                          const OccupancyGrid::Part& part, const Cell& cell) {
    Facet& f = facets_[as_index(number)];
    FacePlane& face_plane = face_planes_[as_index(f.face_plane)];
    (void)count_part(face_plane, number);
    f.is_cut = f.is_cut || part.is_cut;
    f.corners |= part.corners;
    if (f.is_cut || face_plane.is_general) return;
    const auto add = [&](const PolygonRef& p) { add_area(p, f, face_plane.plane); };
    if (!with_part_in<Number>(facet, cell, face_plane.plane.axis, add))
        face_plane.is_general = true;
}

// Outlines of different planes have nothing in common.
template <class Number>
void AxisFaceOutlines<Number>::read_all_units() {
    // More would look at all layers too often.
    const std::uint32_t divisor = threads_ == 1 || with_units_.size() < 16 ? 1 : 4;
    ParallelParts(3 * divisor, divisor == 1 ? 1 : threads_, 1)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                for (const Leaf* const leaf : with_units_)
                    read_units(*leaf, {i % 3, divisor, static_cast<std::uint32_t>(i / 3)});
        });
    with_units_ = {};
}

template <class Number>
void AxisFaceOutlines<Number>::read_units(const Leaf& leaf, const UnitsOf& some) {
    const OccupancyGrid& occupancy = *leaf.occupancy;
    std::array<std::vector<Number>, 3> planes;
    for (std::size_t k = 0; k < 3; ++k) {
        planes[k].reserve(occupancy.planes[k].size());
        for (const Int128 at : occupancy.planes[k]) planes[k].push_back(Numbers::from_wide(at));
    }
    const std::vector<OccupancyGrid::Layer> layers = occupancy.layers(some.axis);
    const UnitFrame frame = UnitFrame::of(some.axis);
    typename Outline::Units units;
    units.row_axis = static_cast<std::uint8_t>((frame.row_axis + 2 - some.axis) % 3);
    units.row_planes = planes[frame.row_axis];
    units.bit_planes = planes[frame.bit_axis];
    const std::size_t rows = units.row_planes.size() - 1;
    for (std::size_t p = 1; p < layers.size(); ++p) {
        const OccupancyGrid::Layer& low = layers[p - 1];
        const OccupancyGrid::Layer& high = layers[p];
        if (std::equal(low.begin(), low.begin() + rows, high.begin())) continue;
        const std::int32_t number = face_plane_ids_.find(key_of(some.axis, planes[some.axis][p]));
        TRISECT_EXPECTS(number >= 0, "no facet bounds a set where it ends");
        FacePlane& face_plane = face_planes_[as_index(number)];
        if (face_plane.is_general || static_cast<std::uint32_t>(number) % some.divisor != some.rest)
            continue;
        for (const bool inside_low : {true, false}) {
            std::uint64_t any = 0;
            for (std::size_t r = 0; r < rows; ++r)
                any |= units.rows[r] = inside_low ? low[r] & ~high[r] : high[r] & ~low[r];
            if (any != 0) face_plane.outline.add(units, inside_low != leaf.complemented);
        }
    }
}

template <class Number>
void AxisFaceOutlines<Number>::block_leaf(const Leaf& leaf) {
    for (const PolygonRef r : *leaf.polygons) {
        const FacetMarks& marks = marks_of(r.source);
        const bool flipped = r.flipped != leaf.complemented;
        if (marks.takes_part(r.facet, flipped))
            facets_[as_index(marks.number_of_worked(r.facet, flipped))].is_blocked = true;
    }
}

template <class Number>
auto AxisFaceOutlines<Number>::face_plane_of(const PolygonRef& polygon, std::int32_t number)
    -> FacePlane& {
    Facet& f = facets_[as_index(number)];
    if (f.face_plane < 0) {
        const PlaneName name = PlaneName::support(polygon.source, polygon.facet);
        const Plane plane = *axis_plane<Number>(name);
        f.face_plane = static_cast<std::int32_t>(&face_plane_at(plane, name) - face_planes_.data());
        f.normal_is_up = plane.sign > 0;
    }
    return face_planes_[as_index(f.face_plane)];
}

// Whether it faces up.
template <class Number>
bool AxisFaceOutlines<Number>::count_part(FacePlane& face_plane, std::int32_t number) {
    const bool faces_up =
        facets_[as_index(number)].normal_is_up != parts_.facets[as_index(number)].flipped;
    auto& first = face_plane.first[faces_up ? 1 : 0];
    if (first < 0 || number < first) first = number;
    ++face_plane.parts;
    return faces_up;
}

template <class Number>
void AxisFaceOutlines<Number>::read_polygon(const PolygonRef& polygon, std::int32_t number,
                                            const Cell& cell, std::vector<Side>& sides) {
    Facet& f = facets_[as_index(number)];
    FacePlane& face_plane = face_planes_[as_index(f.face_plane)];
    if (face_plane.is_general) return;
    const auto add = [&](const PolygonRef& part) {
        if (!read_axis_sides(part, face_plane.plane.axis, sides)) {
            face_plane.is_general = true;
            return;
        }
        face_plane.outline.add(sides, f.normal_is_up, count_part(face_plane, number));
        add_area(part, f, face_plane.plane);
        note_corners(part, f, face_plane.plane.axis, sides);
    };
    if (!with_part_in<Number>(polygon, cell, face_plane.plane.axis, add))
        face_plane.is_general = true;
}

// In doubles from the facet's first corner. Of n products of differences, each off by the errors of
// its vertices and by some roundings.
template <class Number>
void AxisFaceOutlines<Number>::add_area(const PolygonRef& part, Facet& facet,
                                        const Plane& plane) const {
    const std::size_t p = (plane.axis + 1) % 3;
    const std::size_t q = (plane.axis + 2) % 3;
    const Approximation origin = approximate(part.source->corner(part.facet, 0));
    const auto add = [&](std::span<const Approximation> vertices) {
        double sum = 0;
        double reach = 0;
        double error = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Approximation& a = vertices[i];
            const Approximation& b = vertices[i + 1 == vertices.size() ? 0 : i + 1];
            const double x = a.c[p] - origin.c[p];
            const double y = a.c[q] - origin.c[q];
            sum += x * (b.c[q] - origin.c[q]) - y * (b.c[p] - origin.c[p]);
            reach = std::max(reach, std::max(std::fabs(x), std::fabs(y)));
            error = std::max(error, a.error);
        }
        const auto n = static_cast<double>(vertices.size());
        facet.area += std::fabs(sum);
        facet.slack += n * (8 * error * (reach + error) + n * 0x1p-48 * reach * reach);
    };
    if (part.fragment != nullptr) return add(part.fragment->vertices());
    std::array<Approximation, 3> corners;
    for (int i = 0; i < 3; ++i)
        corners[as_index(i)] = approximate(part.source->corner(part.facet, i));
    add(corners);
}

// A corner that a part has is known by that name to facets that pass through.
template <class Number>
void AxisFaceOutlines<Number>::note_corners(const PolygonRef& part, Facet& facet, std::size_t axis,
                                            std::span<const Side> sides) const {
    std::array<bool, 3> near{};
    for (int c = 0; c < 3; ++c)
        near[as_index(c)] = (facet.corners >> c & 1) == 0 &&
                            part.box().overlaps(Box::of(part.source->corner(part.facet, c)));
    if (!near[0] && !near[1] && !near[2]) return;
    if (part.fragment == nullptr) {
        facet.corners = 7;
        return;
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Side& before = sides[i == 0 ? sides.size() - 1 : i - 1];
        const Side& side = sides[i];
        std::array<std::optional<Number>, 2> at;
        if (before.is_slanted && side.is_slanted) {
            const auto& line = before.line;
            const bool ends = line.to == side.line.from || line.to == side.line.to;
            for (std::size_t k = 0; k < 2; ++k)
                at[k] = (ends ? line.to[k] : line.from[k]) * Numbers::scale;
        } else {
            const Side& straight = side.is_slanted ? before : side;
            at[straight.axis] = straight.at;
            at[1 - straight.axis] = end_of_side(straight, side.is_slanted ? side : before);
        }
        for (int c = 0; c < 3; ++c) {
            if (!near[as_index(c)]) continue;
            const LatticePoint& corner = part.source->corner(part.facet, c);
            if (at[0] == axis_position<Number>(coordinate(corner, (axis + 1) % 3)) &&
                at[1] == axis_position<Number>(coordinate(corner, (axis + 2) % 3)))
                facet.corners |= static_cast<std::uint8_t>(1U << c);
        }
    }
}

template <class Number>
void AxisFaceOutlines<Number>::judge() {
    ParallelParts(face_planes_.size(), threads_, least_planes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (FacePlane& s : std::span(face_planes_).subspan(begin, end - begin))
                s.is_general = s.is_general || !s.outline.finish();
        });
    constexpr std::size_t least_judged = 1024;
    PoolVector<std::uint8_t> stay(facets_.size());  // may come out as they went in
    ParallelParts(facets_.size(), threads_, least_judged)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Facet& f = facets_[i];
                if (f.face_plane < 0 || face_planes_[as_index(f.face_plane)].is_general) continue;
                stay[i] = f.is_blocked || !has_changed(static_cast<std::int32_t>(i)) ? 1 : 0;
            }
        });
    for (std::size_t i = 0; i < facets_.size(); ++i)
        if (stay[i] != 0) face_planes_[as_index(facets_[i].face_plane)].is_general = true;
    for (const FacePlane& s : face_planes_) part_count_ += s.is_general ? 0 : s.parts;
    taken_.assign(facets_.size(), false);
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        taken_[i] =
            facets_[i].face_plane >= 0 && !face_planes_[as_index(facets_[i].face_plane)].is_general;
        taken_count_ += taken_[i] ? 1 : 0;
    }
    takes_all_ = taken_count_ == facets_.size();
    if (taken_count_ == 0) passing_ = {};
}

// Surely: a part of it is missing, or an edge of it has a vertex inside.
template <class Number>
bool AxisFaceOutlines<Number>::has_changed(std::int32_t number) const {
    const Facet& f = facets_[as_index(number)];
    const BoundaryFacet& facet = parts_.facets[as_index(number)];
    const FacePlane& face_plane = face_planes_[as_index(f.face_plane)];
    if (f.is_cut) return true;
    Facet all;
    const PolygonRef whole{facet.source, nullptr, facet.facet, false, false};
    add_area(whole, all, face_plane.plane);
    if (all.area - f.area > all.slack + f.slack) return true;
    const bool faces_up = f.normal_is_up != facet.flipped;
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& from = facet.source->corner(facet.facet, i);
        const LatticePoint& to = facet.source->corner(facet.facet, (i + 1) % 3);
        for (std::uint8_t k = 0; k < 2; ++k) {
            const auto across = static_cast<int>((face_plane.plane.axis + 1 + k) % 3);
            const auto along = static_cast<int>((face_plane.plane.axis + 2 - k) % 3);
            if (from[across] != to[across]) continue;
            const Number low = Numbers::place(std::min(from[along], to[along]));
            const Number high = Numbers::place(std::max(from[along], to[along]));
            const Number at = Numbers::place(from[across]);
            if (face_plane.outline.turns_between(faces_up, k, at, low, high)) return true;
        }
    }
    return false;
}

template void AxisFaceOutlines<std::int64_t>::choose(std::span<const Leaf> leaves);
template void AxisFaceOutlines<Int128>::choose(std::span<const Leaf> leaves);

}  // namespace trisect::detail
