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
// Vertices: an interval of an outline is an edge of the solid, where faces of two planes end. If a
// vertex lies inside it, then the faces around change there, and so does one of those two outlines:
// of the four quadrants around the line the two outlines determine those that are inside, and if
// they are the same before and behind, no third plane has a boundary in between. So the ends of all
// intervals on one line are all vertices on it, but for those of facets that are not taken.
//
// Those are facets that may come out as they went in: to_mesh copies them with their corners.
// Whether a facet has changed shows in its area, or in an outline that turns inside one of its
// edges. In doubt its plane is left to the general path.

#include <trisect/bsp/assembly/axis/axis_face_outlines.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/leaf/grid/axis_clip.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Fewer are not worth a part.
constexpr std::size_t least_planes = 8;

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

// --- Which planes.

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
    for (std::size_t k = 0; k < 3; ++k)
        for (const Int128 at : occupancy.planes[k]) planes[k].push_back(Numbers::from_wide(at));
    const std::vector<OccupancyGrid::Layer> layers = occupancy.layers(some.axis);
    const UnitFrame frame = UnitFrame::of(some.axis);
    typename Outline::Units units;
    units.row_axis = static_cast<std::uint8_t>((frame.row_axis + 2 - some.axis) % 3);
    units.row_planes = planes[frame.row_axis];
    units.bit_planes = planes[frame.bit_axis];
    for (std::size_t p = 1; p < layers.size(); ++p) {
        const OccupancyGrid::Layer& low = layers[p - 1];
        const OccupancyGrid::Layer& high = layers[p];
        if (low == high) continue;
        const std::int32_t number = face_plane_ids_.find(key_of(some.axis, planes[some.axis][p]));
        TRISECT_EXPECTS(number >= 0, "no facet bounds a set where it ends");
        FacePlane& face_plane = face_planes_[as_index(number)];
        if (face_plane.is_general || static_cast<std::uint32_t>(number) % some.divisor != some.rest)
            continue;
        for (const bool inside_low : {true, false}) {
            std::uint64_t any = 0;
            for (std::size_t r = 0; r < units.rows.size(); ++r)
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
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        const Facet& f = facets_[i];
        if (f.face_plane < 0) continue;
        FacePlane& s = face_planes_[as_index(f.face_plane)];
        s.is_general = s.is_general || f.is_blocked || !has_changed(static_cast<std::int32_t>(i));
    }
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

// --- Edges.

template <class Number>
void AxisFaceOutlines<Number>::note_vertices(std::span<const BoundaryEdge> edges) {
    if (taken_count_ == 0) return;
    for (const BoundaryEdge& e : edges) others_.push_back(e.from);
}

// Doubles of face planes by axis, sorted.
template <class Number>
auto AxisFaceOutlines<Number>::plane_coordinates() const -> PlaneCoordinates {
    PlaneCoordinates out;
    for (const FacePlane& f : face_planes_)
        out[f.plane.axis].push_back(rounded_axis_position(f.plane.position));
    for (auto& all : out) std::ranges::sort(all);
    return out;
}

// Coordinates that an approximate one may be: a whole one, or those of planes.
template <class Number>
std::span<const double> AxisFaceOutlines<Number>::coordinates_near(const PlaneCoordinates& planes,
                                                                   std::size_t axis,
                                                                   const Approximation& a,
                                                                   double& whole) {
    const double margin = error_slack * a.error;
    if constexpr (Numbers::whole) {
        whole = std::nearbyint(a.c[axis]);
        if (std::fabs(whole - a.c[axis]) > margin || std::fabs(whole) > 0x1p53) return {};
        return {&whole, 1};
    } else {
        const auto& all = planes[axis];
        // Sums round: a little beyond.
        const double reach = margin + last_place * std::fabs(a.c[axis]);
        return {std::to_address(std::ranges::lower_bound(all, a.c[axis] - reach)),
                std::to_address(std::ranges::upper_bound(all, a.c[axis] + reach))};
    }
}

// Where a point is, if it is on planes across all axes. What names it need not say so.
template <class Number>
std::optional<LatticePoint> AxisFaceOutlines<Number>::place_of(
    PointId p, const PlaneCoordinates& planes) const {
    const Workbench& bench = parts_.bench;
    if (bench.is_lattice(p)) {
        const LatticePoint at = bench.lattice(p);
        return Numbers::takes(at) ? std::optional(at) : std::nullopt;
    }
    const Approximation& a = bench.approximation(p);
    const auto is_there = [&](const LatticePoint& place) {
        return std::ranges::all_of(bench.planes_of(p), [&](PlaneId plane) {
            return side_of(place, bench.plane_at(plane)) == trisect::Side::On;
        });
    };
    std::array<double, 3> whole{};
    const auto near = [&](std::size_t k) { return coordinates_near(planes, k, a, whole[k]); };
    for (const double x : near(0))
        for (const double y : near(1))
            for (const double z : near(2))
                if (const LatticePoint at{Coordinate(x), Coordinate(y), Coordinate(z)};
                    is_there(at))
                    return at;
    return std::nullopt;
}

template <class Number>
void AxisFaceOutlines<Number>::place_others() {
    std::ranges::sort(others_);
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
    const PlaneCoordinates planes = Numbers::whole ? PlaneCoordinates{} : plane_coordinates();
    std::size_t kept = 0;
    for (const PointId p : others_) {
        const auto place = place_of(p, planes);
        if (!place) continue;
        others_[kept++] = p;
        places_.push_back(*place);
    }
    others_.resize(kept);
}

template <class Number>
std::uint32_t AxisFaceOutlines<Number>::rank(std::size_t axis, Number at) const {
    const auto& all = coordinates_[axis];
    return static_cast<std::uint32_t>(std::ranges::lower_bound(all, at) - all.begin());
}

template <class Number>
auto AxisFaceOutlines<Number>::ranks_of(const LatticePoint& p) const -> Ranks {
    const auto at = [&](std::size_t k) { return rank(k, Numbers::place(coordinate(p, k))); };
    return {at(0), at(1), at(2)};
}

// Corners of parts count as vertices even where all faces run straight on: a facet with one inside
// an edge has changed, and whether facets are put together one by one must not show. Where none are
// only those of facets that pass through count, and the others have a name to give.
template <class Number>
void AxisFaceOutlines<Number>::list_corners() {
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        if (!taken_[i]) continue;
        const BoundaryFacet& f = parts_.facets[i];
        for (int c = 0; c < 3; ++c)
            if ((facets_[i].corners >> c & 1) != 0) corners_.push_back({f.source, f.facet, c});
    }
    first_passing_ = corners_.size();
    for (const PolygonName& p : passing_)
        for (int c = 0; c < 3; ++c) corners_.push_back({p.source, p.facet, c});
    passing_ = {};
}

// Outlines turn where planes of other axes are, so their places need not be listed.
template <class Number>
void AxisFaceOutlines<Number>::rank_coordinates() {
    const auto add = [&](const LatticePoint& p) {
        for (std::size_t k = 0; k < 3; ++k)
            coordinates_[k].push_back(Numbers::place(coordinate(p, k)));
    };
    for (const LatticePoint& p : places_) add(p);
    for (const CornerName& c : corners_) add(c.source->corner(c.facet, c.corner));
    for (const FacePlane& s : face_planes_)
        coordinates_[s.plane.axis].push_back(Numbers::place_of(s.plane.position));
    for (std::size_t k = 0; k < 3; ++k) {
        auto& all = coordinates_[k];
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
        face_plane_of_[k].assign(all.size(), -1);
    }
    for (std::size_t i = 0; i < face_planes_.size(); ++i) {
        const Plane& p = face_planes_[i].plane;
        face_planes_[i].rank = rank(p.axis, Numbers::place_of(p.position));
        face_plane_of_[p.axis][face_planes_[i].rank] = static_cast<std::int32_t>(i);
    }
    ParallelParts(face_planes_.size(), threads_, least_planes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (FacePlane& s : std::span(face_planes_).subspan(begin, end - begin))
                if (!s.is_general) rank_places(s);
        });
}

// Neighbours in an outline mostly have neighbouring ranks.
template <class Number>
void AxisFaceOutlines<Number>::rank_places(FacePlane& face_plane) {
    std::array<std::uint32_t, 2> last{};
    face_plane.outline.rank_places([&](std::size_t i, Number place) {
        const std::size_t axis = (face_plane.plane.axis + 1 + i) % 3;
        const auto& all = coordinates_[axis];
        std::uint32_t& r = last[i];
        if (all[r] != place && (++r >= all.size() || all[r] != place)) r = rank(axis, place);
        TRISECT_EXPECTS(r < all.size() && all[r] == place, "an outline turns where no plane is");
        return Number{r};
    });
}

// A vertex is named by the corner of a source if there is one there: by the first.
template <class Number>
void AxisFaceOutlines<Number>::name_corners() {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Ranks at =
            ranks_of(corners_[i].source->corner(corners_[i].facet, corners_[i].corner));
        const bool is_new = corner_ids_.insert(key_of(at), static_cast<std::int32_t>(i)).second;
        if (takes_all_ ? i >= first_passing_ : is_new) add_other(at);
    }
    for (const LatticePoint& p : places_) add_other(ranks_of(p));
    for (auto& others : other_stops_) {
        std::ranges::sort(others);
        others.erase(std::unique(others.begin(), others.end()), others.end());
    }
}

template <class Number>
void AxisFaceOutlines<Number>::add_other(const Ranks& at) {
    for (std::size_t k = 0; k < 3; ++k) other_stops_[k].push_back({line_at(k, at), at[k]});
}

template <class Number>
auto AxisFaceOutlines<Number>::line_of(const FacePlane& face_plane, const Interval& interval)
    -> Ranks {
    Ranks at{};
    at[face_plane.plane.axis] = face_plane.rank;
    at[across_of(face_plane, interval)] = static_cast<std::uint32_t>(interval.at);
    return at;
}

template <class Number>
void AxisFaceOutlines<Number>::make_stops() {
    for (FacePlane& s : face_planes_)
        if (!s.is_general) s.stops.resize(s.outline.intervals().size());
    for (FacePlane& s : face_planes_) {
        if (s.is_general) continue;
        for (const typename Outline::Run& run : s.outline.runs())
            if (s.stops[run.first].end == 0) add_line(s, s.outline.intervals()[run.first]);
    }
}

// All vertices on the line of an interval, for all intervals there.
template <class Number>
void AxisFaceOutlines<Number>::add_line(FacePlane& face_plane, const Interval& interval) {
    const std::size_t across = across_of(face_plane, interval);
    const std::size_t along = along_of(face_plane, interval);
    const Ranks at = line_of(face_plane, interval);
    FacePlane& beside = face_plane_at_rank(across, at[across]);
    std::array<FacePlane*, 2> face_planes{&face_plane, beside.is_general ? nullptr : &beside};
    std::array<LineRun, 4> runs;
    std::size_t count = 0;
    line_.clear();
    for (FacePlane* const s : face_planes) {
        if (s == nullptr) continue;
        const std::size_t other = s == &face_plane ? across : face_plane.plane.axis;
        const auto axis = static_cast<std::uint8_t>((other + 2 - s->plane.axis) % 3);
        for (const bool faces_up : {false, true}) {
            const std::size_t run = s->outline.run_at(faces_up, axis, at[other]);
            if (run == s->outline.runs().size()) continue;
            runs[count++] = {s, s->outline.runs()[run]};
            for (const Interval& t : runs[count - 1].intervals()) {
                line_.push_back(static_cast<std::uint32_t>(t.low));
                line_.push_back(static_cast<std::uint32_t>(t.high));
            }
        }
    }
    for (const Other& o : others_on(along, at)) line_.push_back(o.place);
    std::ranges::sort(line_);
    line_.erase(std::unique(line_.begin(), line_.end()), line_.end());
    const auto first = static_cast<std::uint32_t>(stops_.size());
    for (const std::uint32_t place : line_) stops_.push_back({place});
    if (keeps_lines_) {
        lines_[along].insert({line_at(along, at), 0}, static_cast<std::int32_t>(all_lines_.size()));
        all_lines_.push_back({first, static_cast<std::uint32_t>(stops_.size())});
    }
    for (const LineRun& r : std::span(runs).first(count)) {
        std::uint32_t i = 0;
        for (std::uint32_t n = r.run.first; n < r.run.end; ++n) {
            const Interval& t = r.face_plane->outline.intervals()[n];
            while (line_[i] != t.low) ++i;
            r.face_plane->stops[n].first = first + i;
            while (line_[i] != t.high) ++i;
            r.face_plane->stops[n].end = first + i + 1;
        }
    }
}

template <class Number>
auto AxisFaceOutlines<Number>::others_on(std::size_t along, const Ranks& line) const
    -> std::span<const Other> {
    const std::vector<Other>& all = other_stops_[along];
    const LineKey key = line_at(along, line);
    const auto first = std::ranges::lower_bound(all, key, {}, &Other::line);
    const auto end = std::ranges::upper_bound(first, all.end(), key, {}, &Other::line);
    return {std::to_address(first), std::to_address(end)};
}

template <class Number>
auto AxisFaceOutlines<Number>::face_plane_at_rank(std::size_t axis, std::uint32_t rank)
    -> FacePlane& {
    const std::int32_t face_plane = face_plane_of_[axis][rank];
    TRISECT_EXPECTS(face_plane >= 0, "an outline turns where no plane is");
    return face_planes_[as_index(face_plane)];
}

template <class Number>
PlaneId AxisFaceOutlines<Number>::plane_of(std::size_t axis, std::uint32_t rank) {
    FacePlane& s = face_plane_at_rank(axis, rank);
    if (s.id < 0) s.id = parts_.bench.plane(s.name);
    return s.id;
}

template <class Number>
PointId AxisFaceOutlines<Number>::point_at(const Ranks& ranks) {
    const Key128 key = key_of(ranks);
    if (const PointId known = point_ids_.find(key); known >= 0) return known;
    return point_ids_.insert(key, make_point(ranks)).first;
}

template <class Number>
PointId AxisFaceOutlines<Number>::make_point(const Ranks& ranks) {
    if (const std::int32_t c = corner_ids_.find(key_of(ranks)); c >= 0) {
        const CornerName& name = corners_[as_index(c)];
        return parts_.bench.corner(name.source, name.facet, name.corner);
    }
    Approximation at;
    for (std::size_t k = 0; k < 3; ++k) at.c[k] = Numbers::to_double(coordinates_[k][ranks[k]]);
    return parts_.bench.vertex({}, plane_of(0, ranks[0]), plane_of(1, ranks[1]),
                               plane_of(2, ranks[2]), at);
}

template <class Number>
void AxisFaceOutlines<Number>::make_edges(BoundaryEdges& edges) {
    if (taken_count_ == 0) return;
    keeps_lines_ = !others_.empty();
    place_others();
    list_corners();
    rank_coordinates();
    name_corners();
    make_stops();
    for (std::size_t i = 0; i < others_.size(); ++i)
        (void)point_ids_.insert(key_of(ranks_of(places_[i])), others_[i]);
    edges.reserve(edges.size() + count_edges());
    for (const Face& face : faces_in_order()) {
        check_stop(face.intervals.size());
        make_edges_of(face, edges);
    }
}

// In the order of their facets.
template <class Number>
auto AxisFaceOutlines<Number>::faces_in_order() const -> std::vector<Face> {
    std::vector<Face> faces;
    for (std::size_t i = 0; i < face_planes_.size(); ++i)
        for (const bool faces_up : {false, true})
            if (const std::int32_t first = face_planes_[i].first[faces_up ? 1 : 0];
                first >= 0 && !face_planes_[i].is_general)
                faces.push_back({first, i, faces_up, {}});
    std::ranges::sort(faces, {}, &Face::first);
    ParallelParts(faces.size(), threads_, least_planes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (Face& f : std::span(faces).subspan(begin, end - begin))
                f.intervals = face_planes_[f.face_plane].outline.loops(f.faces_up);
        });
    return faces;
}

template <class Number>
std::size_t AxisFaceOutlines<Number>::count_edges() const {
    std::size_t out = 0;
    for (const FacePlane& s : face_planes_)
        for (const Stops& stops : s.stops) out += stops.end - stops.first - 1;
    return out;
}

template <class Number>
void AxisFaceOutlines<Number>::make_edges_of(const Face& face, BoundaryEdges& edges) {
    FacePlane& face_plane = face_planes_[face.face_plane];
    BoundaryFacet& f = parts_.facets[as_index(face.first)];
    f.support = parts_.bench.plane(PlaneName::support(f.source, f.facet));
    f.parts = 1;
    for (const std::uint32_t n : face.intervals) {
        const Interval& s = face_plane.outline.intervals()[n];
        const std::size_t across = across_of(face_plane, s);
        const std::size_t along = along_of(face_plane, s);
        Ranks at = line_of(face_plane, s);
        const FacePlane& beside = face_plane_at_rank(across, at[across]);
        BoundaryEdge e{-1, -1, face.first, {}};
        e.line = {plane_of(across, at[across]), s.is_low == (beside.plane.sign > 0)};
        const auto stops = std::span(stops_).subspan(
            face_plane.stops[n].first, face_plane.stops[n].end - face_plane.stops[n].first);
        for (std::size_t i = 0; i < stops.size(); ++i) {
            Stop& stop = stops[s.runs_up() ? i : stops.size() - 1 - i];
            at[along] = stop.place;
            if (stop.point < 0) stop.point = point_at(at);
            e.from = std::exchange(e.to, stop.point);
            if (i != 0) edges.push_back(e);
        }
    }
}

// An edge ends at splitting planes too, for which doubles suffice: the caller checks the result.
template <class Number>
void AxisFaceOutlines<Number>::add_vertices_in(const BoundaryEdge& edge, PoolVector<PointId>& out) {
    const Workbench& bench = parts_.bench;
    const auto support =
        axis_plane<Number>(bench.name(parts_.facets[as_index(edge.facet)].support));
    const auto beside = axis_plane<Number>(bench.name(edge.line.plane));
    if (!support || !beside) return;
    Ranks at{};
    for (const Plane& p : {*support, *beside}) {
        const Number place = Numbers::place_of(p.position);
        at[p.axis] = rank(p.axis, place);
        if (!Numbers::is_place(p.position) || at[p.axis] == coordinates_[p.axis].size() ||
            coordinates_[p.axis][at[p.axis]] != place)
            return;
    }
    const std::size_t along = 3 - support->axis - beside->axis;
    const Approximation& from = bench.approximation(edge.from);
    const Approximation& to = bench.approximation(edge.to);
    const auto rank_at = [&](double c) { return rank(along, Numbers::place_near(c)); };
    const auto [low, high] = std::minmax(from.c[along], to.c[along]);
    const double margin = 2 + from.error + to.error;
    const std::uint32_t first = rank_at(low - margin);
    const std::uint32_t last = rank_at(high + margin);
    const auto add = [&](std::uint32_t place) {
        if (place + 1 < first || place > last) return;
        at[along] = place;
        out.push_back(point_at(at));
    };
    if (const std::int32_t line = lines_[along].find({line_at(along, at), 0}); line >= 0) {
        const Stops& on_line = all_lines_[as_index(line)];
        for (std::uint32_t i = on_line.first; i < on_line.end; ++i) add(stops_[i].place);
    } else {
        for (const Other& o : others_on(along, at)) add(o.place);
    }
}

template class AxisFaceOutlines<std::int64_t>;
template class AxisFaceOutlines<Int128>;

}  // namespace trisect::detail
