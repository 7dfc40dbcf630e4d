// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/outline_store.h>

#include <algorithm>

#include <trisect/bsp/many_meshes/outlines/box_sum.h>

namespace trisect::detail {

namespace {

// Of so many facets edges and vertices get room at once, as of this many at most: what is not
// touched costs nothing, and an array that grows lies in new memory. Operands come and go, so that
// a store seldom has all.
constexpr std::size_t many_facets = std::size_t{1} << 20;
constexpr std::size_t most_reserved = std::size_t{1} << 21;
// Few large facets cross each other often.
constexpr std::size_t many_lines = std::size_t{1} << 16;

constexpr std::uint32_t unused = ~std::uint32_t{0};

// Of corners, which have no errors.
OutlineBox box_of(const Vector3& a, const Vector3& b, const Vector3& c) {
    BoxSum out({a, a});
    out.add({b, b});
    out.add({c, c});
    return out.box();
}

// Where lines begin at another number.
EdgeOrigin moved(const EdgeOrigin& origin, std::size_t from, std::size_t to) {
    return origin.has_line() ? EdgeOrigin::of_line(origin.line() - from + to) : origin;
}

}  // namespace

void OutlineStore::reserve(const ManyMeshes& meshes) {
    const std::size_t facets = meshes.facet_count();
    facets_.reserve(facets);
    boxes_.reserve(facets);
    lines_.reserve(std::min(std::max(facets, std::min(4 * facets, many_lines)), most_reserved));
    if (facets < many_facets || edges_.capacity() != 0) return;
    const std::size_t some = std::min(facets, most_reserved);
    edges_.reserve(3 * some);
    vertices_.reserve(some);
}

OutlineStore::Solid OutlineStore::empty_solid(bool open_far_out) const {
    Solid out;
    out.facets = facets_.size();
    out.edges = edges_.size();
    out.vertices = vertices_.size();
    out.lines = lines_.size();
    out.settled = settled_.size();
    out.open_far_out = open_far_out;
    return out;
}

OutlinedSolid OutlineStore::view(const Solid& solid, const Solid& next) const {
    OutlinedSolid out;
    const std::size_t count = next.facets - solid.facets;
    out.facets = std::span(facets_).subspan(solid.facets, count);
    out.boxes = std::span(boxes_).subspan(solid.facets, count);
    out.edges = edges_;
    out.vertices = vertices_;
    out.lines = lines_;
    out.box = solid.box;
    out.settled = std::span(settled_).subspan(solid.settled, next.settled - solid.settled);
    out.open_far_out = solid.open_far_out;
    out.united = solid.united;
    return out;
}

OutlineStore::Solid OutlineStore::add_operand(const ManyMeshes& meshes, std::uint32_t slot,
                                              bool open_far_out) {
    const LatticeMesh& mesh = meshes.sources[slot]->mesh();
    const std::uint32_t first = meshes.operands->operands[slot].first;
    Solid out = empty_solid(open_far_out);
    const auto vertex = static_cast<std::uint32_t>(out.vertices);
    const auto edge = static_cast<std::uint32_t>(out.edges);
    vertices_.resize(out.vertices + mesh.points.size());
    OutlineVertex* const vertices = vertices_.data() + out.vertices;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
        vertices[v].at = {mesh.points[v].doubles(), 0.0};
    const std::size_t count = mesh.triangles.size();
    facets_.resize(out.facets + count);
    boxes_.resize(out.facets + count);
    edges_.resize(out.edges + 3 * count);
    Edge* next_edge = edges_.data() + out.edges;
    BoxSum all;
    for (std::uint32_t f = 0; f < count; ++f) {
        const auto& t = mesh.triangles[f];
        facets_[out.facets + f] = {first + f, slot, edge + 3 * f, 3, true};
        for (std::uint32_t i = 0; i < 3; ++i) {
            *next_edge++ = {vertex + t[i], vertex + t[i == 2 ? 0 : i + 1], EdgeOrigin(i)};
            vertices[t[i]].facets[0] = first + f;
            vertices[t[i]].which = static_cast<std::int8_t>(i);
        }
        OutlineBox& box = boxes_[out.facets + f];
        box = box_of(vertices[t[0]].at.c, vertices[t[1]].at.c, vertices[t[2]].at.c);
        all.add(box);
    }
    out.box = all.box();
    return out;
}

void OutlineStore::cut_off(const Solid& solid) {
    facets_.resize(solid.facets);
    boxes_.resize(solid.facets);
    edges_.resize(solid.edges);
    vertices_.resize(solid.vertices);
    lines_.resize(solid.lines);
    settled_.resize(solid.settled);
}

SettledParts OutlineStore::take_out(const Solid& solid) {
    SettledParts out;
    for (std::size_t i = solid.settled; i < settled_.size(); ++i)
        out.push_back(std::move(settled_[i]));
    SettledPart& rest = *out.emplace_back(std::make_unique<SettledPart>());
    rest.facets.reserve(facets_.size() - solid.facets);
    rest.boxes.reserve(facets_.size() - solid.facets);
    rest.edges.reserve(edges_.size() - solid.edges);
    rest.vertices.reserve(vertices_.size() - solid.vertices);
    rest.lines.reserve(lines_.size() - solid.lines);
    rest.box = solid.box;
    const auto end_of = [](auto& items, std::size_t first) {
        return std::span(items).subspan(first);
    };
    const auto vertex = static_cast<std::uint32_t>(solid.vertices);
    const auto edge = static_cast<std::uint32_t>(solid.edges);
    for (const Facet& f : end_of(facets_, solid.facets))
        rest.facets.push_back({f.number, f.slot, f.first - edge, f.count, f.whole});
    for (const OutlineBox& b : end_of(boxes_, solid.facets)) rest.boxes.push_back(b);
    for (const Edge& e : end_of(edges_, solid.edges))
        rest.edges.push_back({e.from - vertex, e.to - vertex, moved(e.origin, solid.lines, 0)});
    for (const OutlineVertex& v : end_of(vertices_, solid.vertices)) rest.vertices.push_back(v);
    for (const FacetCrossing& l : end_of(lines_, solid.lines)) rest.lines.push_back(l);
    cut_off(solid);
    return out;
}

OutlineStore::Solid OutlineStore::put(SettledParts parts, const Solid& solid) {
    Solid out = empty_solid(solid.open_far_out);
    out.unused_edges = solid.unused_edges;
    out.box = solid.box;
    out.united = solid.united;
    const auto vertex = static_cast<std::uint32_t>(out.vertices);
    const auto edge = static_cast<std::uint32_t>(out.edges);
    const std::unique_ptr<SettledPart> rest = std::move(parts.back());
    parts.pop_back();
    for (const Facet& f : rest->facets)
        facets_.push_back({f.number, f.slot, f.first + edge, f.count, f.whole});
    boxes_.insert(boxes_.end(), rest->boxes.begin(), rest->boxes.end());
    for (const Edge& e : rest->edges)
        edges_.push_back({e.from + vertex, e.to + vertex, moved(e.origin, 0, out.lines)});
    vertices_.insert(vertices_.end(), rest->vertices.begin(), rest->vertices.end());
    lines_.insert(lines_.end(), rest->lines.begin(), rest->lines.end());
    for (auto& part : parts) settled_.push_back(std::move(part));
    return out;
}

OutlineStore::Solid OutlineStore::united_apart(const Solid& first, const Solid& second) const {
    Solid out = first;
    out.unused_edges += second.unused_edges;
    out.box.add(second.box);
    return out;
}

OutlineStore::Solid OutlineStore::first_only(const Solid& first, const Solid& second) {
    cut_off(second);
    return first;
}

OutlineStore::Solid OutlineStore::none_of(const Solid& solid) {
    cut_off(solid);
    return empty_solid(solid.open_far_out);
}

OutlineStore::Solid OutlineStore::second_only(const Solid& first, const Solid& second) {
    const auto move_down = [](auto& items, std::size_t to, std::size_t from) {
        const auto at = [&](std::size_t i) {
            return items.begin() + static_cast<std::ptrdiff_t>(i);
        };
        items.erase(at(to), at(from));
    };
    move_down(facets_, first.facets, second.facets);
    move_down(boxes_, first.facets, second.facets);
    move_down(settled_, first.settled, second.settled);
    Solid out = second;
    out.facets = first.facets;
    out.edges = first.edges;
    out.vertices = first.vertices;
    out.lines = first.lines;
    out.settled = first.settled;
    out.unused_edges += second.edges - first.edges;
    tidy(out);
    return out;
}

void OutlineStore::tidy(Solid& solid) {
    if (2 * solid.unused_edges <= edges_.size() - solid.edges) return;
    tidy_edges_.clear();
    tidy_edges_.reserve(edges_.size() - solid.edges - solid.unused_edges);
    for (std::size_t i = solid.facets; i < facets_.size(); ++i) {
        Facet& f = facets_[i];
        const auto own = std::span(edges_).subspan(f.first, f.count);
        f.first = static_cast<std::uint32_t>(solid.edges + tidy_edges_.size());
        tidy_edges_.insert(tidy_edges_.end(), own.begin(), own.end());
    }
    tidy_vertices(solid);
    tidy_lines(solid);
    edges_.resize(solid.edges);
    edges_.insert(edges_.end(), tidy_edges_.begin(), tidy_edges_.end());
    solid.unused_edges = 0;
}

// Of edges that are left.
void OutlineStore::tidy_vertices(const Solid& solid) {
    numbers_.assign(vertices_.size() - solid.vertices, unused);
    for (const Edge& e : tidy_edges_) numbers_[e.from - solid.vertices] = 0;
    std::size_t next = solid.vertices;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        if (numbers_[i] == unused) continue;
        numbers_[i] = static_cast<std::uint32_t>(next);
        vertices_[next++] = vertices_[solid.vertices + i];
    }
    vertices_.resize(next);
    for (Edge& e : tidy_edges_) {
        e.from = numbers_[e.from - solid.vertices];
        e.to = numbers_[e.to - solid.vertices];
    }
}

void OutlineStore::tidy_lines(const Solid& solid) {
    constexpr std::size_t few_lines = 4096;  // larger solids take out those of smaller ones
    if (lines_.size() - solid.lines <= few_lines) return;
    numbers_.assign(lines_.size() - solid.lines, unused);
    for (const Edge& e : tidy_edges_)
        if (e.origin.has_line()) numbers_[e.origin.line() - solid.lines] = 0;
    std::size_t next = solid.lines;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        if (numbers_[i] == unused) continue;
        numbers_[i] = static_cast<std::uint32_t>(next);
        lines_[next++] = lines_[solid.lines + i];
    }
    lines_.resize(next);
    for (Edge& e : tidy_edges_)
        if (e.origin.has_line())
            e.origin = EdgeOrigin::of_line(numbers_[e.origin.line() - solid.lines]);
}

}  // namespace trisect::detail
