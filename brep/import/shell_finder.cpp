// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/import/shell_finder.h>

#include <algorithm>
#include <limits>

#include <trisect/brep/import/volume_sign.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

ShellFinder::ShellFinder(const PreparedMesh& mesh, const EdgeTable& edges) : mesh_(mesh) {
    sets_.start(mesh.face_count());
    edges.for_each_edge([this](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
        if (uses.size() == 2) sets_.join(uses[0].face(), uses[1].face());
    });
    edges.for_each_edge([this](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
        if (uses.size() > 2) join_where_open(uses);
    });
    open_.assign(mesh.face_count(), false);
    edges.for_each_edge([this](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
        for (const auto& [root, net] : net_by_shell(uses))
            if (net != 0) open_[root] = true;
    });
}

std::vector<Shell> ShellFinder::shells() {
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> index(mesh_.face_count(), none);
    std::vector<Shell> out;
    shell_of_triangle.clear();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        const std::uint32_t f = mesh_.face_of_triangle[t];
        const std::uint32_t r = sets_.root(f);
        if (index[r] == none) {
            index[r] = static_cast<std::uint32_t>(out.size());
            out.push_back({{}, f, !open_[r], 0});
        }
        out[index[r]].triangles.push_back(mesh_.triangles[t]);
        shell_of_triangle.push_back(index[r]);
    }
    for (Shell& s : out)
        if (s.closed) s.volume = volume_sign(mesh_.points, s.triangles);
    return out;
}

std::vector<std::pair<std::uint32_t, std::int64_t>> ShellFinder::net_by_shell(
    std::span<const EdgeUse> uses) {
    std::vector<std::pair<std::uint32_t, std::int64_t>> nets;
    check_stop();
    for (const EdgeUse& u : uses) {
        const std::uint32_t r = sets_.root(u.face());
        const auto it =
            std::find_if(nets.begin(), nets.end(), [r](const auto& n) { return n.first == r; });
        const std::int64_t step = u.is_forward() ? 1 : -1;
        if (it == nets.end()) {
            nets.emplace_back(r, step);
        } else {
            it->second += step;
        }
    }
    return nets;
}

void ShellFinder::join_where_open(std::span<const EdgeUse> uses) {
    const auto nets = net_by_shell(uses);
    const bool open =
        std::any_of(nets.begin(), nets.end(), [](const auto& n) { return n.second != 0; });
    if (open)
        for (const auto& n : nets) sets_.join(n.first, nets[0].first);
}

}  // namespace trisect::detail
