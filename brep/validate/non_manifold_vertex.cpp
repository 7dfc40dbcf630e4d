// SPDX-License-Identifier: Apache-2.0
//
// non_manifold_vertex: faces around a vertex that do not form one fan. Corners are linked when they
// share an edge at the vertex; one linked group is one fan. A solid may touch itself in a vertex.

#include <algorithm>
#include <numeric>
#include <utility>

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

namespace {

// Every corner of every loop, dealt to its vertex: the neighbours of the vertex in the loop.
struct CornerAtVertex {
    std::uint32_t previous, next, face;
};

class CornerTable {
public:
    explicit CornerTable(const PreparedMesh& mesh) : begin_(mesh.points.size() + 2, 0) {
        for_each(mesh,
                 [this](std::uint32_t v, const CornerAtVertex&) { ++begin_[std::size_t{v} + 2]; });
        for (std::size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        corners_.resize(begin_.back());
        for_each(mesh, [this](std::uint32_t v, const CornerAtVertex& c) {
            corners_[begin_[std::size_t{v} + 1]++] = c;
        });
        begin_.pop_back();
    }
    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    [[nodiscard]] std::span<const CornerAtVertex> at(std::size_t v) const {
        return {corners_.data() + begin_[v], corners_.data() + begin_[v + 1]};
    }

private:
    template <class Visit>
    static void for_each(const PreparedMesh& mesh, const Visit& visit) {
        std::vector<std::uint32_t> loop;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            loop.clear();
            for (const std::uint32_t c : mesh.loop(f))
                if (loop.empty() || loop.back() != c) loop.push_back(c);
            while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
            const std::size_t n = loop.size();
            if (n < 3) continue;
            for (std::size_t i = 0; i < n; ++i)
                visit(loop[i], CornerAtVertex{loop[(i + n - 1) % n], loop[(i + 1) % n], f});
        }
    }
    std::vector<std::uint32_t> begin_;
    std::vector<CornerAtVertex> corners_;
};

class FanCounter {
public:
    std::size_t count(std::span<const CornerAtVertex> corners) {
        root_.resize(corners.size());
        std::iota(root_.begin(), root_.end(), 0U);
        ends_.clear();
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            ends_.emplace_back(corners[i].previous, i);
            ends_.emplace_back(corners[i].next, i);
        }
        std::sort(ends_.begin(), ends_.end());
        std::size_t fans = corners.size();
        for (std::size_t i = 1; i < ends_.size(); ++i) {
            if (ends_[i].first != ends_[i - 1].first) continue;
            const std::uint32_t a = find(ends_[i - 1].second);
            const std::uint32_t b = find(ends_[i].second);
            if (a == b) continue;
            root_[b] = a;
            --fans;
        }
        return fans;
    }

private:
    std::uint32_t find(std::uint32_t i) {
        while (root_[i] != i) i = root_[i] = root_[root_[i]];
        return i;
    }
    std::vector<std::uint32_t> root_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_;
};

}  // namespace

void check_non_manifold_vertices(const CheckedMesh& m, ValidationReport& report) {
    const CornerTable table(m.mesh);
    FanCounter counter;
    for (std::uint32_t v = 0; v < table.size(); ++v) {
        const auto corners = table.at(v);
        if (corners.empty()) continue;
        const std::size_t fans = counter.count(corners);
        if (fans == 1) continue;
        report.add(DefectKind::NonManifoldVertex, [&] {
            std::vector<std::uint32_t> faces;
            for (const CornerAtVertex& c : corners) faces.push_back(c.face);
            return Defect{
                DefectKind::NonManifoldVertex,
                {m.name(v)},
                std::move(faces),
                m.place(v),
                "the faces around " + m.vertex_text(v) + " form " + std::to_string(fans) + " fans"};
        });
    }
}

}  // namespace trisect::detail
