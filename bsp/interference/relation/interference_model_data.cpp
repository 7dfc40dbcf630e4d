// SPDX-License-Identifier: Apache-2.0
//
// Triangles with classified sides.
//
// Contacts are found between triangles and named by edges and faces, so each side of a triangle
// needs to classify it as an edge of the B-rep or a diagonal. A side is an edge if some halfedge of
// the face runs the same way between the same places: a face lies on the left of its halfedges, so
// at most one of them does. Places, not vertex ids, because a triangulation may use any of several
// corners of a face that touches itself at a vertex.

#include <trisect/bsp/interference/relation/interference_model_data.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <trisect/brep/triangulate.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/seconds_since.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

namespace {

VertexId place_of(const Brep& brep, VertexId v) {
    const auto copies = brep.copies(v);
    return copies.empty() ? v : *std::min_element(copies.begin(), copies.end());
}

// Halfedges of a face by the places that they join.
class Sides {
public:
    Sides(const Brep& brep, FaceId face) : brep_(brep) {
        for (const HalfedgeId h : brep.halfedges(face))
            sides_.push_back(
                {place_of(brep, brep.origin(h)), place_of(brep, brep.target(h)), brep.edge(h)});
        std::sort(sides_.begin(), sides_.end());
    }
    [[nodiscard]] EdgeId edge(VertexId from, VertexId to) const {
        const Side wanted{place_of(brep_, from), place_of(brep_, to), EdgeId(0)};
        const auto it = std::lower_bound(sides_.begin(), sides_.end(), wanted);
        if (it == sides_.end() || it->from != wanted.from || it->to != wanted.to) return {};
        return it->edge;
    }

private:
    struct Side {
        VertexId from;
        VertexId to;
        EdgeId edge;
        friend auto operator<=>(const Side&, const Side&) = default;
    };
    const Brep& brep_;
    std::vector<Side> sides_;
};

// Balls take about as long as some thousand queries; after so many queries there may be more.
constexpr std::uint32_t questions_before_balls = 1000;

}  // namespace

void append_triangles(const Brep& brep, FaceId face, std::vector<ModelTriangle>& triangles) {
    const auto halfedges = brep.halfedges(face);
    if (halfedges.size() == 3) {
        ModelTriangle t;
        for (std::size_t i = 0; i < 3; ++i) {
            t.vertex[i] = brep.origin(halfedges[i]);
            t.edge[i] = brep.edge(halfedges[i]);
        }
        t.face = face;
        triangles.push_back(t);
        return;
    }
    const Sides sides(brep, face);
    for (const IndexTriangle& corners : triangulate(brep, face)) {
        ModelTriangle t;
        for (std::size_t i = 0; i < 3; ++i) t.vertex[i] = VertexId(corners[i]);
        for (std::size_t i = 0; i < 3; ++i)
            t.edge[i] = sides.edge(t.vertex[i], t.vertex[(i + 1) % 3]);
        t.face = face;
        triangles.push_back(t);
    }
}

InterferenceModelData::InterferenceModelData(const LazyModel& m, const Brep& b)
    : model(m), brep(b) {
    const auto start = std::chrono::steady_clock::now();
    lattice = brep.lattice();
    first_triangle.reserve(brep.faces().size() + 1);
    for (const FaceId f : brep.faces()) {
        check_stop();
        append_triangles(brep, f, triangles);
        first_triangle.push_back(static_cast<std::uint32_t>(triangles.size()));
    }
    triangulate_seconds = seconds_since(start);

    positions.reserve(brep.vertices().size());
    place.reserve(brep.vertices().size());
    for (const VertexId v : brep.vertices()) {
        const Point& p = brep.point(v);
        all_lattice = all_lattice && p.is_lattice();
        positions.push_back(p.nearest());
        place.push_back(place_of(brep, v));
        for (const double c : positions.back()) largest = std::max(largest, std::abs(c));
    }
    // Correct rounding moves a coordinate of magnitude m by at most 2^-53 m; those below the
    // smallest normal number, which rounding may move by more, by less than the bound all the same.
    if (!all_lattice)
        position_error = std::max(unit_roundoff * largest, std::numeric_limits<double>::min());

    if (!positions.empty()) lo = hi = positions.front();
    for (const auto& p : positions)
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], p[k]);
            hi[k] = std::max(hi[k], p[k]);
        }
    if (!all_lattice)
        for (std::size_t k = 0; k < 3; ++k) {
            // The subtraction rounds; the next double is beyond.
            lo[k] = std::nextafter(lo[k] - position_error, -INFINITY);
            hi[k] = std::nextafter(hi[k] + position_error, INFINITY);
        }
    const auto boxes_start = std::chrono::steady_clock::now();
    std::vector<std::array<std::uint32_t, 3>> corners;
    corners.reserve(triangles.size());
    for (const ModelTriangle& t : triangles)
        corners.push_back({t.vertex[0].index, t.vertex[1].index, t.vertex[2].index});
    boxes = ObbTree(positions, position_error, corners);
    boxes_seconds = seconds_since(boxes_start);
    clear_ = std::vector<std::atomic<std::uint8_t>>(triangles.size());
    for (const ShellId s : brep.shells())
        shell_vertex.push_back(
            brep.origin(brep.halfedges(brep.outer_loop(brep.faces(s).front()))[0]));
}

const InsideBalls& InterferenceModelData::balls() const {
    work_once(balls_once_, [this] {
        if (!is_empty()) balls_ = InsideBalls(*this);
        questions_.store(questions_before_balls, std::memory_order_release);
    });
    return balls_;
}

const InsideBalls* InterferenceModelData::balls_in_time() const {
    if (questions_.load(std::memory_order_acquire) < questions_before_balls &&
        questions_.fetch_add(1, std::memory_order_relaxed) + 1 < questions_before_balls)
        return nullptr;
    return &balls();
}

std::size_t InterferenceModelData::bytes() const {
    return triangles.size() * sizeof(ModelTriangle) +
           first_triangle.size() * sizeof(std::uint32_t) + positions.size() * sizeof(positions[0]) +
           boxes.bytes() + clear_.size() + (place.size() + shell_vertex.size()) * sizeof(VertexId);
}

}  // namespace trisect::detail
