// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/duplicates.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <trisect/brep/import/edge_table.h>

namespace trisect::detail {

namespace {

// The loop from its least corner on, towards the lower neighbour. Corners of a loop are mostly
// different; a loop that names one twice may have several such forms, and is then no duplicate.
struct LoopForm {
    std::vector<std::uint32_t> corners;
    bool reversed = false;
};

LoopForm form_of(std::span<const std::uint32_t> loop) {
    LoopForm out;
    out.corners.assign(loop.begin(), loop.end());
    const auto least = std::min_element(out.corners.begin(), out.corners.end());
    std::rotate(out.corners.begin(), least, out.corners.end());
    if (out.corners.size() > 2 && out.corners.back() < out.corners[1]) {
        std::reverse(out.corners.begin() + 1, out.corners.end());
        out.reversed = true;
    }
    return out;
}

class DuplicateFinder {
public:
    explicit DuplicateFinder(const MendingMesh& mesh)
        : mesh_(mesh), left_out_(mesh.face_count(), false) {}

    void run(MendReport& report) {
        find_groups();
        drop_opposites(report);
    }
    [[nodiscard]] bool is_left_out(std::uint32_t face) const { return left_out_[face]; }

private:
    struct Opposites {
        std::uint32_t first, second;
        bool has_odd = false, has_even = false;  // edges, by the numbers of other faces
    };

    // All but the first of each orientation are out; pairs of both orientations are noted.
    void find_groups() {
        std::vector<std::uint32_t> order(mesh_.face_count());
        std::iota(order.begin(), order.end(), 0U);
        std::vector<LoopForm> forms;
        forms.reserve(order.size());
        for (const std::uint32_t f : order) forms.push_back(form_of(mesh_.loop(f)));
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return forms[a].corners < forms[b].corners;
        });
        for (std::size_t i = 0; i < order.size();) {
            std::size_t end = i + 1;
            while (end < order.size() && forms[order[end]].corners == forms[order[i]].corners)
                ++end;
            const std::uint32_t first = order[i];
            std::uint32_t opposite = no_face;
            for (++i; i < end; ++i) {
                const std::uint32_t f = order[i];
                if (forms[f].reversed != forms[first].reversed && opposite == no_face) {
                    opposite = f;
                } else {
                    left_out_[f] = true;
                }
            }
            if (opposite != no_face) opposites_.push_back({first, opposite});
        }
    }

    void drop_opposites(MendReport& report) {
        if (opposites_.empty()) return;
        std::vector<std::uint32_t> pair_of(mesh_.face_count(), no_face);
        for (std::size_t i = 0; i < opposites_.size(); ++i) {
            pair_of[opposites_[i].first] = static_cast<std::uint32_t>(i);
            pair_of[opposites_[i].second] = static_cast<std::uint32_t>(i);
        }
        // Each pair uses its edges twice, so only single faces count.
        const EdgeTable edges(mesh_.points.size(), mesh_.loop_begin, mesh_.corners);
        edges.for_each_edge([&](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
            const auto singles = std::ranges::count_if(uses, [&](const EdgeUse& u) {
                return pair_of[u.face()] == no_face && !left_out_[u.face()];
            });
            for (const EdgeUse& u : uses)
                if (const std::uint32_t p = pair_of[u.face()]; p != no_face)
                    (singles % 2 == 1 ? opposites_[p].has_odd : opposites_[p].has_even) = true;
        });
        for (const Opposites& o : opposites_) {
            if (o.has_odd && o.has_even) {
                ++report.duplicates_left;
            } else {
                left_out_[o.second] = true;
                left_out_[o.first] = o.has_even;
            }
        }
    }

    const MendingMesh& mesh_;
    std::vector<bool> left_out_;
    std::vector<Opposites> opposites_;
};

}  // namespace

void drop_duplicates(MendingMesh& mesh, MendReport& report) {
    DuplicateFinder finder(mesh);
    finder.run(report);
    MendingMesh out;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (finder.is_left_out(f)) {
            report.duplicate_faces.push_back(mesh.face_source[f]);
        } else {
            out.add_face(mesh.loop(f), mesh.face_source[f]);
        }
    }
    if (out.face_count() < mesh.face_count()) mesh.take_faces(std::move(out));
}

}  // namespace trisect::detail
