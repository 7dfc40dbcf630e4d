// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/brep_index.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <trisect/bsp/detail/index_cells.h>
#include <trisect/bsp/detail/index_core.h>
#include <trisect/bsp/detail/index_handles.h>
#include <trisect/bsp/detail/index_ray.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::IndexBase;
using detail::IndexCore;
using detail::IndexLine;
using detail::IndexPoint;
using detail::PolygonId;

// A boundary that may cross itself is made free of that first.
Solid resolved(const Solid& solid) {
    return solid.state()->embedded ? solid : evaluate(Expression(solid));
}

// All facets of one source in one leaf: then facets keep their numbers.
const detail::Source* only_source(const Solid& solid) {
    const detail::CellRef& root = solid.state()->root;
    if (root.complemented || !root.node->is_leaf()) return nullptr;
    const detail::Source* source = nullptr;
    std::uint32_t next = 0;
    for (const detail::PolygonRef r : root.node->polygons()) {
        if (next == 0) source = r.source;
        if (r.source != source || r.fragment != nullptr || r.flipped || r.facet != next++)
            return nullptr;
    }
    if (source == nullptr || source->is_half_space() || next != source->facet_count())
        return nullptr;
    return source;
}

Place located(const IndexCore& core, const IndexPoint& point, std::vector<PolygonId>& on) {
    Place place;
    place.location = detail::locate_polygons(*core.base, point, on);
    if (!place.is_on_boundary()) return place;
    place = detail::place_on(core.polygons(), on, point);
    if (core.handles) core.handles->name(core, place, on, point);
    return place;
}

// Calls work(i) for all i below n, in parts, on so many threads.
template <class Work>
void for_each_part(std::size_t n, unsigned threads, const Work& work) {
    if (threads == 1 || n < 1024) {
        work(std::size_t{0}, n);
        return;
    }
    const auto all = [&] {
        oneapi::tbb::parallel_for(
            oneapi::tbb::blocked_range<std::size_t>(0, n, 256),
            [&](const oneapi::tbb::blocked_range<std::size_t>& r) { work(r.begin(), r.end()); });
    };
    if (threads == 0) {
        all();
    } else {
        oneapi::tbb::task_arena arena(static_cast<int>(threads));
        arena.execute(all);
    }
}

}  // namespace

namespace detail {

IndexBase::IndexBase(const Solid& s) : solid(resolved(s)) {
    const auto start = std::chrono::steady_clock::now();
    if (const Source* source = only_source(solid)) polygons = IndexPolygons(*source);
    tree = IndexTree(*solid.state(), polygons);
    std::vector<PolygonId> on;
    tree.set_inside_beyond(locate_polygons(*this, IndexPoint(tree.lo()), on) == Location::Inside);
    build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace detail

const char* to_string(Location location) {
    switch (location) {
        case Location::Outside:
            return "outside";
        case Location::OnFace:
            return "face";
        case Location::OnEdge:
            return "edge";
        case Location::OnVertex:
            return "vertex";
        case Location::Inside:
            return "inside";
    }
    return "";
}

BrepIndex::BrepIndex(const Solid& solid) {
    auto core = std::make_shared<IndexCore>();
    core->base = std::make_shared<const IndexBase>(solid);
    core_ = std::move(core);
}

BrepIndex BrepIndex::with_brep() const {
    if (core_->handles) return *this;
    auto core = std::make_shared<IndexCore>();
    core->base = core_->base;
    core->handles = std::make_shared<const detail::IndexHandles>(*core->base);
    return BrepIndex(std::shared_ptr<const IndexCore>(std::move(core)));
}

const Solid& BrepIndex::solid() const { return core_->base->solid; }
bool BrepIndex::has_brep() const { return core_->handles != nullptr; }

const Brep& BrepIndex::brep() const {
    TRISECT_EXPECTS(has_brep(), "an index without B-rep was asked for it");
    return core_->handles->brep();
}

IndexStats BrepIndex::stats() const {
    const detail::IndexTree& tree = core_->tree();
    IndexStats s;
    s.polygons = core_->polygons().size();
    s.nodes = tree.nodes().size();
    s.mixed_leaves = tree.leaves().size();
    for (const auto& n : tree.nodes())
        if (n.is_leaf() && !n.is_mixed()) ++s.empty_leaves;
    for (const auto& l : tree.leaves()) s.listed += l.count;
    s.depth = tree.depth();
    s.bytes = tree.bytes() + core_->polygons().bytes();
    if (core_->handles) s.bytes += core_->handles->bytes();
    if (s.polygons != 0)
        s.bytes_per_polygon = static_cast<double>(s.bytes) / static_cast<double>(s.polygons);
    s.build_seconds = core_->base->build_seconds;
    if (core_->handles) s.brep_seconds = core_->handles->seconds();
    return s;
}

Place BrepIndex::locate(const std::array<double, 3>& point) const {
    std::vector<PolygonId> on;
    return located(*core_, IndexPoint::from_user(point, solid().lattice()), on);
}

Place BrepIndex::locate(const LatticePoint& point) const {
    std::vector<PolygonId> on;
    return located(*core_, IndexPoint(point), on);
}

Place BrepIndex::locate(const Point& point) const {
    std::vector<PolygonId> on;
    return located(*core_, IndexPoint(point), on);
}

std::vector<Place> BrepIndex::locate(std::span<const std::array<double, 3>> points,
                                     unsigned threads) const {
    std::vector<Place> places(points.size());
    const Lattice lattice = solid().lattice();
    for_each_part(points.size(), threads, [&](std::size_t begin, std::size_t end) {
        std::vector<PolygonId> on;
        for (std::size_t i = begin; i < end; ++i)
            places[i] = located(*core_, IndexPoint::from_user(points[i], lattice), on);
    });
    return places;
}

void BrepIndex::classify(std::span<const std::array<double, 3>> points, std::span<Location> results,
                         unsigned threads) const {
    if (points.size() != results.size()) throw UsageError("as many results as points are needed");
    const Lattice lattice = solid().lattice();
    for_each_part(points.size(), threads, [&](std::size_t begin, std::size_t end) {
        std::vector<PolygonId> on;
        for (std::size_t i = begin; i < end; ++i) {
            const IndexPoint p = IndexPoint::from_user(points[i], lattice);
            results[i] = detail::locate_polygons(*core_->base, p, on);
            if (results[i] == Location::OnFace)
                results[i] = detail::place_on(core_->polygons(), on).location;
        }
    });
}

std::optional<RayHit> BrepIndex::first_hit(const Ray& ray) const {
    return detail::first_hit(*core_, IndexLine(ray, solid().lattice()));
}
std::optional<RayHit> BrepIndex::first_hit(const Segment& segment) const {
    return detail::first_hit(*core_, IndexLine(segment, solid().lattice()));
}
std::vector<RayHit> BrepIndex::all_hits(const Ray& ray) const {
    return detail::all_hits(*core_, IndexLine(ray, solid().lattice()));
}
std::vector<RayHit> BrepIndex::all_hits(const Segment& segment) const {
    return detail::all_hits(*core_, IndexLine(segment, solid().lattice()));
}

IndexCell BrepIndex::cell_at(const std::array<double, 3>& point) const {
    return detail::cell_at(*core_->base, IndexPoint::from_user(point, solid().lattice()));
}

}  // namespace trisect
