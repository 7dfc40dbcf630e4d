// SPDX-License-Identifier: Apache-2.0
//
// Bounds. The value of a plane at a point is the determinant of Shewchuk ("Adaptive precision
// floating-point arithmetic", 1997, orient3d), developed along the row of the point: it errs by at
// most (7 + 56 ε) ε times the permanent, ε = 2^-53, rounded differences included. Here 8 ε times
// the permanent for the farthest point that the leaf has. A point that is off by e changes the
// value by at most e times the sum of the normal's components, whose magnitudes the minors'
// permanents bound.
//
// Origins. Corners are differences of coordinates from the leaf's origin, and have to be exact.
// Whole coordinates near each other have exact differences whatever the origin. With fractions it
// is chosen axis by axis: with L the extent of all corners and m the least magnitude of one, it is
// a corner's coordinate where L <= m, else 0. In the first case all coordinates have one sign and
// none is more than twice another: a difference of such doubles is exact (Sterbenz). In the second
// nothing is subtracted, and coordinates are below 2 L: the errors are still those of the leaf's
// size.
//
// Half-spaces. The plane n x + d = 0 has at the leaf's origin the value c, which is computed in
// integers; in doubles it is the plane through the point -c / n_k on the axis k of its largest
// component. Rounding of n and of that point, and what evaluation rounds, are below 2^-50 of the
// sum of |n_i| times the leaf's extent, and of 2 |c|. Corners of outlines may lie far beyond the
// extent of the leaf's meshes, so their errors have 2^-49 of their distance more: that is what a
// plane's value there, of any facet, may be off by in relation to its slope.

#include <trisect/bsp/leaf/doubles/filtered_facets.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// Differences of lattice positions up to this are exact.
constexpr double exact_limit = 0x1p53;

// Corners lie anywhere in memory: they are prefetched well before their turn. The names of their
// points are already there, since all of the leaf's were prefetched first.
void look_ahead(std::span<const PolygonRef> polygons) {
    constexpr std::size_t near = 6;
    if (polygons.size() <= near || polygons[near].source->is_half_space()) return;
    const LatticeMesh& mesh = polygons[near].source->mesh();
    for (const std::uint32_t v : mesh.triangles[polygons[near].facet])
        __builtin_prefetch(&mesh.points[v]);
}

struct Polygons {
    std::size_t count = 0;
    bool whole = true;
    bool unbounded = false;  // some are
};

// The polygons of a leaf, if all can be held in doubles; prefetches their triangles.
std::optional<Polygons> filtered_polygons(const LeafProblem& leaf) {
    Polygons found;
    for (const LeafOperand& o : leaf.operands) {
        if (!o.embedded) return std::nullopt;
        found.count += o.polygons.size();
        for (const PolygonRef& r : o.polygons) {
            if (r.fragment != nullptr && r.fragment->edges().size() > FilteredFacet::max_outline)
                return std::nullopt;
            found.whole = found.whole && r.source->is_whole();
            if (r.source->is_half_space()) {
                found.unbounded = found.unbounded || r.fragment == nullptr;
                continue;
            }
            __builtin_prefetch(&r.source->mesh().triangles[r.facet]);
        }
    }
    return found;
}

// Of any facet that has corners.
const PolygonRef* facet_of_mesh(const LeafProblem& leaf) {
    for (const LeafOperand& o : leaf.operands)
        for (const PolygonRef& r : o.polygons)
            if (!r.source->is_half_space()) return &r;
    return nullptr;
}

// How far beyond its meshes, in extents of them, a leaf has to reach for the planes of half-spaces
// to be listed in pieces.
constexpr std::int64_t far_beyond = 4;

// The same without a call, which std::floor is on the oldest processors of the family.
std::int64_t floor_of(double v) {
    const auto whole = static_cast<std::int64_t>(v);
    return whole - (static_cast<double>(whole) > v ? 1 : 0);
}

}  // namespace

void FilteredFacets::set_origin(const Vector3& origin) {
    origin_ = origin;
    for (std::size_t k = 0; k < 3; ++k) whole_origin_[k] = floor_of(origin[k]);
    if (whole_) {
        set_bounds();
    } else {
        set_bounds_with_fractions();
    }
}

void FilteredFacets::set_bounds() {
    const Cell& cell = problem_.cell;
    reference_.error = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto from_origin = [&](std::int64_t fine) {
            return rounded_position(fine - whole_origin_[k] * splitting_scale);
        };
        splitter_lo_[k] = from_origin(cell.lo[k]);
        splitter_hi_[k] = from_origin(cell.hi[k]);
        reference_.c[k] = from_origin(problem_.reference.c[k]);
        reference_.error = std::max(reference_.error, std::fabs(reference_.c[k]) * last_place);
        const auto inner = [&](std::int64_t c) {
            return std::clamp(static_cast<double>(c - whole_origin_[k]), -exact_limit, exact_limit);
        };
        inner_lo_[k] = inner(lattice_below(cell.lo[k]) + 1);
        inner_hi_[k] = inner(lattice_below(cell.hi[k]));
        outer_lo_[k] = inner_lo_[k] - 1;
        outer_hi_[k] = inner_hi_[k] + 1;
    }
}

// A position from the whole origin is rounded once, by 2^-53 of itself, and once more with the rest
// of the origin, which is below 1: what comes out is off by less than 2^-52 of itself and 2^-52.
void FilteredFacets::set_bounds_with_fractions() {
    const Cell& cell = problem_.cell;
    reference_.error = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double rest = origin_[k] - static_cast<double>(whole_origin_[k]);
        const auto from_origin = [&](std::int64_t fine) {
            return rounded_position(fine - whole_origin_[k] * splitting_scale) - rest;
        };
        const auto error = [&](double at) { return std::fabs(at) * last_place + splitter_error(); };
        splitter_lo_[k] = from_origin(cell.lo[k]);
        splitter_hi_[k] = from_origin(cell.hi[k]);
        reference_.c[k] = from_origin(problem_.reference.c[k]);
        reference_.error = std::max(reference_.error, 2 * error(reference_.c[k]));
        inner_lo_[k] = splitter_lo_[k] + 2 * error(splitter_lo_[k]);
        inner_hi_[k] = splitter_hi_[k] - 2 * error(splitter_hi_[k]);
        outer_lo_[k] = splitter_lo_[k] - 1;
        outer_hi_[k] = splitter_hi_[k] + 1;
    }
}

Vector3 FilteredFacets::origin_of_fractions() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vector3 low{infinity, infinity, infinity};
    Vector3 high{-infinity, -infinity, -infinity};
    Vector3 least{infinity, infinity, infinity};
    for (const LeafOperand& o : problem_.operands)
        for (const PolygonRef& r : o.polygons)
            for (int i = 0; i < 3 && !r.source->is_half_space(); ++i) {
                const Vector3 c = r.source->corner(r.facet, i).doubles();
                for (std::size_t k = 0; k < 3; ++k) {
                    low[k] = std::min(low[k], c[k]);
                    high[k] = std::max(high[k], c[k]);
                    least[k] = std::min(least[k], std::fabs(c[k]));
                }
            }
    Vector3 origin{};
    // A rounded extent that is no larger is enough: then no coordinate is more than twice another.
    for (std::size_t k = 0; k < 3; ++k)
        if (low[k] * high[k] > 0 && std::max(std::fabs(low[k]), std::fabs(high[k])) <= 2 * least[k])
            origin[k] = low[k];
    return origin;
}

Box FilteredFacets::positions(const Vector3& lo, const Vector3& hi) const {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        if (whole_) {
            box.lo[k] = whole_origin_[k] + floor_of(lo[k]);
            box.hi[k] = whole_origin_[k] - floor_of(-hi[k]);
            continue;
        }
        const auto slack = [&](double v) {
            return 0x1p-51 * (std::fabs(v) + std::fabs(origin_[k]));
        };
        box.lo[k] = floor_of(origin_[k] + lo[k] - slack(lo[k]));
        box.hi[k] = -floor_of(-(origin_[k] + hi[k] + slack(hi[k])));
    }
    return box;
}

// Adds the polygons of a leaf, operand by operand, and finds how far they reach.
class FilteredFacets::Lister {
public:
    explicit Lister(FilteredFacets& all)
        : all_(all),
          low_(all.reference_.c),
          high_(all.reference_.c),
          inner_lo_(all.inner_lo_),
          inner_hi_(all.inner_hi_),
          outer_lo_(all.outer_lo_),
          outer_hi_(all.outer_hi_) {
        if (all.whole_) return;
        for (std::size_t k = 0; k < 3; ++k) {
            low_[k] = std::min(low_[k], 0.0);  // the origin, which else is a corner
            high_[k] = std::max(high_[k], 0.0);
        }
    }

    void list(std::size_t number) {
        const LeafOperand& operand = all_.problem_.operands[number];
        source_ = nullptr;
        all_.firsts_[number] = all_.size();
        for (std::size_t i = 0; i < operand.polygons.size(); ++i) {
            const PolygonRef& ref = operand.polygons[i];
            look_ahead(operand.polygons.subspan(i));
            if (ref.fragment != nullptr || !ref.source->is_half_space()) {
                add(ref, operand, number);
                continue;
            }
            for (const Piece& p : all_.pieces_)
                if (p.operand == number && p.ref.source == ref.source) add(p.ref, operand, number);
        }
    }
    // Whether doubles hold all of it.
    [[nodiscard]] bool set_extent() {
        for (std::size_t k = 0; k < 3; ++k) {
            small_ = small_ && low_[k] > -exact_limit && high_[k] < exact_limit;
            const double extent = high_[k] - low_[k];
            all_.extent_[k] = all_.whole_ ? extent + 1 : extent * slightly_more;
        }
        return small_;
    }

private:
    void add(const PolygonRef& ref, const LeafOperand& operand, std::size_t number) {
        if (ref.source != source_) {
            source_ = ref.source;
            surface_ = all_.surfaces_
                           .insert({reinterpret_cast<std::uintptr_t>(source_),
                                    static_cast<std::uint32_t>(number)},
                                   static_cast<LeafIndex>(all_.surfaces_.size()))
                           .first;
        }
        all_.add(ref, operand, static_cast<LeafIndex>(number), surface_);
        FilteredFacet& f = all_.facets_.back();
        const Vector3 lo = f.lo;
        const Vector3 hi = f.hi;
        clip(f, all_.reaches_[number]);
        if (!f.is_of_half_space())
            for (std::size_t k = 0; k < 3; ++k) {
                low_[k] = std::min(low_[k], lo[k]);
                high_[k] = std::max(high_[k], hi[k]);
            }
        if (!f.is_whole()) look_at_fragment(f, lo, hi);
    }
    void clip(FilteredFacet& f, Reach& reach) const {
        bool contained = true;
        for (std::size_t k = 0; k < 3; ++k) {
            contained &= f.lo[k] >= inner_lo_[k];
            contained &= f.hi[k] <= inner_hi_[k];
            f.lo[k] = std::max(f.lo[k], outer_lo_[k]);
            f.hi[k] = std::min(f.hi[k], outer_hi_[k]);
            reach.lo[k] = std::min(reach.lo[k], f.lo[k]);
            reach.hi[k] = std::max(reach.hi[k], f.hi[k]);
        }
        f.contained = contained;
    }
    // With its box before that was clipped.
    void look_at_fragment(FilteredFacet& f, const Vector3& lo, const Vector3& hi) {
        if (f.is_beyond) {
            f.contained = false;
            return;
        }
        if (!all_.whole_) f.contained = all_.problem_.cell.contains(f.ref.fragment->box());
        if (!f.contained) f.contained = all_.is_contained_but_for_splitters(f.splitters, lo, hi);
        if (f.is_of_half_space()) return;
        // Planes are evaluated at points relative to their first corner. What doubles hold of a
        // fragment's facet need not be near the fragment.
        for (std::size_t k = 0; k < 3; ++k) {
            low_[k] = std::min(low_[k], f.corners[0][k]);
            high_[k] = std::max(high_[k], f.corners[0][k]);
            for (std::size_t c = 1; c < 3; ++c)
                small_ = small_ && std::fabs(f.corners[c][k]) < exact_limit;
        }
    }

    FilteredFacets& all_;
    const Source* source_ = nullptr;  // of the facet before
    LeafIndex surface_ = -1;
    // Over all points compared with a plane.
    Vector3 low_;
    Vector3 high_;
    bool small_ = true;
    Vector3 inner_lo_;
    Vector3 inner_hi_;
    Vector3 outer_lo_;
    Vector3 outer_hi_;
};

bool FilteredFacets::list(const LeafProblem& leaf) {
    problem_ = leaf;
    facets_.clear();
    outlines_.clear();
    fragments_ = 0;
    surfaces_.clear();
    const std::optional<Polygons> polygons = filtered_polygons(leaf);
    if (!polygons) return false;
    facets_.reserve(polygons->count);
    whole_ = polygons->whole;
    firsts_.assign(leaf.operands.size() + 1, 0);
    reaches_.assign(leaf.operands.size(), {});
    if (polygons->count == 0) return true;
    const PolygonRef* const any = facet_of_mesh(leaf);
    if (any == nullptr) return false;
    set_origin(whole_ ? any->source->corner(any->facet, 0).doubles() : origin_of_fractions());
    pieces_.clear();
    if (polygons->unbounded) make_pieces();
    Lister lister(*this);
    for (std::size_t o = 0; o < leaf.operands.size(); ++o) lister.list(o);
    firsts_.back() = size();
    return lister.set_extent();
}

void FilteredFacets::add(const PolygonRef& ref, const LeafOperand& operand, LeafIndex number,
                         LeafIndex surface) {
    FilteredFacet& f = facets_.emplace_back();
    f.ref = ref;
    f.ref.flipped = ref.flipped != operand.flipped;
    f.orientation = f.ref.flipped ? -1 : 1;
    f.operand = number;
    f.surface = surface;
    if (f.is_of_half_space()) {
        add_half_space(f);
        return;
    }
    const LatticeMesh& mesh = ref.source->mesh();
    f.vertices = mesh.triangles[ref.facet];
    for (std::size_t i = 0; i < 3; ++i) {
        f.corners[i] = minus(mesh.points[f.vertices[i]].doubles(), origin_);
    }
    if (!f.is_whole()) {
        add_box(f);
        return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        f.lo[k] = std::min({f.corners[0][k], f.corners[1][k], f.corners[2][k]});
        f.hi[k] = std::max({f.corners[0][k], f.corners[1][k], f.corners[2][k]});
    }
}

// Numbers that no vertex of a mesh has, and no corners.
void FilteredFacets::add_half_space(FilteredFacet& f) {
    f.vertices.fill(std::numeric_limits<std::uint32_t>::max());
    for (Vector3& c : f.corners) c = {};
    add_box(f);
}

// The planes of half-spaces in the cell, while nothing else is listed.
void FilteredFacets::make_pieces() {
    Box meshes;
    for (const LeafOperand& o : problem_.operands)
        for (const PolygonRef& r : o.polygons)
            if (!r.source->is_half_space())
                meshes.add(r.box().intersected(problem_.cell.lattice_box()));
    if (bench_ == nullptr) bench_ = std::make_unique<Workbench>();
    bench_->clear();
    for (std::size_t o = 0; o < problem_.operands.size(); ++o)
        for (const PolygonRef& r : problem_.operands[o].polygons)
            if (r.source->is_half_space() && r.fragment == nullptr) add_pieces(r, o, meshes);
    std::vector<PolygonRef> refs;
    refs.reserve(pieces_.size());
    for (const Piece& p : pieces_) refs.push_back(p.ref);
    kept_pieces_ = PolygonList(std::move(refs));
}

// What is far beyond the meshes is cut off, side by side: the corners of a piece in a cell that is
// as large as space would be of no use for the facets here.
void FilteredFacets::add_pieces(const PolygonRef& ref, std::size_t operand, const Box& meshes) {
    const Cell& cell = problem_.cell;
    const auto add = [&](const WorkPolygon& part) {
        if (!part.is_empty()) pieces_.push_back({operand, make_fragment(*bench_, ref, part)});
    };
    WorkPolygon rest = bench_->clipped(bench_->polygon(ref), ref.box(), cell);
    std::int64_t extent = 1;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, meshes.hi[k] - meshes.lo[k]);
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        for (const bool high : {false, true}) {
            if (rest.is_empty()) return;
            const std::int64_t end = high ? meshes.hi[k] : meshes.lo[k];
            const std::int64_t wall = high ? lattice_below(cell.hi[k]) : lattice_below(cell.lo[k]);
            if (std::abs(wall - end) / far_beyond <= extent) continue;
            const std::int64_t at = (high ? end + extent : end - extent) * splitting_scale +
                                    problem_.options->splitting_offset;
            const PlaneId splitter = bench_->plane(PlaneName::splitter(axis, at));
            add(bench_->clipped(rest, splitter, high ? 1 : -1));
            rest = bench_->clipped(std::move(rest), splitter, high ? -1 : 1);
        }
    }
    add(rest);
}

FilteredPlane FilteredFacets::plane_of_half_space(const FilteredFacet& f) const {
    const Plane support = f.ref.source->support(f.ref.facet);
    const WideInt<2> unit(Int128{1} << fraction_limit);
    WideInt<9> value = multiply<9>(support.offset(), unit);
    FilteredPlane p;
    double sum = 0;
    double permanent = 0;
    std::size_t axis = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const int i = static_cast<int>(k);
        const WideInt<2> at(scaled_integer(Coordinate(origin_[k]), fraction_limit));
        value += multiply<9>(support.normal(i), at);
        p.normal[k] = support.approx_normal(i);
        const double size = std::fabs(p.normal[k]);
        if (size > std::fabs(p.normal[axis])) axis = k;
        permanent += size * extent_[k];
        sum += size;
    }
    const double c = std::ldexp(value.to_double(), -fraction_limit - support.approx_shift());
    p.origin = {};
    p.origin[axis] = -c / p.normal[axis];
    p.bound = 0x1p-50 * (permanent + 2 * std::fabs(c));
    p.slope = bound_slack * sum;
    return p;
}

void FilteredFacets::add_box(FilteredFacet& f) {
    const Fragment& fragment = *f.ref.fragment;
    ++fragments_;
    f.size = static_cast<std::uint8_t>(fragment.edges().size());
    find_splitters(f);
    if (whole_) {
        for (std::size_t k = 0; k < 3; ++k) {
            f.lo[k] = static_cast<double>(fragment.box().lo[k] - whole_origin_[k]);
            f.hi[k] = static_cast<double>(fragment.box().hi[k] - whole_origin_[k]);
        }
        return;
    }
    // The box counts units, which may be much.
    constexpr double infinity = std::numeric_limits<double>::infinity();
    f.lo = {infinity, infinity, infinity};
    f.hi = {-infinity, -infinity, -infinity};
    for (const Approximation& v : fragment.vertices()) {
        const Approximation a = from_lattice(v);
        for (std::size_t k = 0; k < 3; ++k) {
            f.lo[k] = std::min(f.lo[k], a.c[k] - bound_slack * a.error);
            f.hi[k] = std::max(f.hi[k], a.c[k] + bound_slack * a.error);
        }
    }
}

// Whether a box reaches beyond those bounding planes of the cell only at which its fragment ends.
bool FilteredFacets::is_contained_but_for_splitters(unsigned splitters, const Vector3& lo,
                                                    const Vector3& hi) const {
    for (std::size_t k = 0; k < 3; ++k, splitters >>= 2)
        if ((lo[k] < inner_lo_[k] && (splitters & 1U) == 0) ||
            (hi[k] > inner_hi_[k] && (splitters & 2U) == 0))
            return false;
    return true;
}

// Of a fragment: its corners from the leaf's origin, with the rounding that this takes.
void FilteredFacets::add_outline(FilteredFacet& f) {
    f.outline = static_cast<std::uint32_t>(outlines_.size());
    const std::span<const Approximation> vertices = f.ref.fragment->vertices();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        Approximation a = vertices[i];
        if (const int corner = f.mesh_corner(i); corner >= 0) {
            a = {f.corners[static_cast<std::size_t>(corner)], 0.0};
        } else {
            double largest = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                a.c[k] -= origin_[k];
                largest = std::max(largest, std::fabs(a.c[k]));
            }
            a.error = bound_slack * a.error + 0x1p-51 * largest;
            if (f.is_of_half_space()) a.error += 0x1p-49 * largest;
        }
        outlines_.push_back(a);
    }
}

// At which bounding planes of the cell a fragment ends, or before: with its edge on a splitting
// plane it is on one side of that. Where that is the other side of a bounding plane, only its box,
// rounded to positions of the lattice, meets the cell.
void FilteredFacets::find_splitters(FilteredFacet& f) const {
    const Cell& cell = problem_.cell;
    unsigned splitters = 0;
    for (const EdgeName& e : f.ref.fragment->edges()) {
        if (!e.plane.is_splitter()) continue;
        const std::size_t k = e.plane.facet;
        const std::int64_t at = e.plane.position();
        if (e.above && at >= cell.lo[k]) splitters |= 1U << 2 * k;
        if (!e.above && at <= cell.hi[k]) splitters |= 2U << 2 * k;
        if (e.above ? at >= cell.hi[k] : at <= cell.lo[k]) f.is_beyond = true;
    }
    f.splitters = static_cast<std::uint8_t>(splitters);
}

FilteredPlane FilteredFacets::plane_of(const std::array<Vector3, 3>& corners,
                                       const Vector3& extent) {
    Vector3 u;
    Vector3 v;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = corners[1][k] - corners[0][k];
        v[k] = corners[2][k] - corners[0][k];
    }
    FilteredPlane p;
    p.origin = corners[0];
    double permanent = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const double s = u[i] * v[j];
        const double t = u[j] * v[i];
        p.normal[k] = s - t;
        const double minor = std::fabs(s) + std::fabs(t);
        permanent += minor * extent[k];
        sum += minor;
    }
    p.bound = 0x1p-50 * permanent;
    p.slope = bound_slack * sum;
    return p;
}

std::optional<int> exact_orientation(const Vector3& a, const Vector3& b, const Vector3& c,
                                     const Vector3& d) {
    // Minors are below 2^83, the sum of their three products with a difference below 2^126.
    constexpr double limit = 0x1p41;
    std::array<std::array<Int128, 3>, 3> m;
    for (std::size_t k = 0; k < 3; ++k) {
        std::size_t row = 0;
        for (const Vector3* p : {&a, &b, &c}) {
            const double difference = (*p)[k] - d[k];
            if (std::fabs(difference) > limit) return std::nullopt;
            m[row++][k] = static_cast<std::int64_t>(difference);
        }
    }
    Int128 sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        sum += m[0][k] * (m[1][i] * m[2][j] - m[1][j] * m[2][i]);
    }
    return sum > 0 ? 1 : (sum < 0 ? -1 : 0);
}

}  // namespace trisect::detail
