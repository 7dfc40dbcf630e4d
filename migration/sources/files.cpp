// SPDX-License-Identifier: Apache-2.0
//
// OBJ files, and meshes whose vertices are joined.

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

#include <manifold/manifold.h>

#include "disjoint_sets.h"
#include "tri_mesh.h"

namespace manifold {

MeshGL64 ReadOBJ(std::istream& stream) {
    MeshGL64 mesh;
    std::string line;
    while (std::getline(stream, line)) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key == "v") {
            double x = 0;
            for (int i = 0; i < 3 && words >> x; ++i) mesh.vertProperties.push_back(x);
        } else if (key == "f") {
            std::vector<std::uint64_t> corners;
            std::string corner;
            while (words >> corner) corners.push_back(std::stoull(corner) - 1);
            for (std::size_t i = 2; i < corners.size(); ++i)
                for (const std::uint64_t c : {corners[0], corners[i - 1], corners[i]})
                    mesh.triVerts.push_back(c);
        } else if (key == "#") {
            // What theirs writes so that tolerances survive.
            std::string name;
            char sign = 0;
            double value = 0;
            if (words >> name >> sign >> value && name == "tolerance") mesh.tolerance = value;
        }
    }
    return mesh;
}

bool WriteOBJ(std::ostream& stream, const MeshGL64& mesh) {
    stream.precision(std::numeric_limits<double>::max_digits10);
    for (std::size_t v = 0; v < mesh.NumVert(); ++v) {
        const vec3 p = mesh.GetVertPos(v);
        stream << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
    for (std::size_t t = 0; t < mesh.NumTri(); ++t) {
        const auto c = mesh.GetTriVerts(t);
        stream << "f " << c.x + 1 << ' ' << c.y + 1 << ' ' << c.z + 1 << '\n';
    }
    return static_cast<bool>(stream);
}

Manifold Manifold::ReadOBJ(std::istream& stream) { return manifold::ReadOBJ(stream); }
bool Manifold::WriteOBJ(std::ostream& stream) const {
    if (Status() != Error::NoError) return false;
    MeshGL64 mesh = GetMeshGL64();
    // Vertices of the solid: without properties there is one at each place.
    if (NumProp() != 0) mesh = SetProperties(0, nullptr).GetMeshGL64();
    return manifold::WriteOBJ(stream, mesh);
}

namespace {

// Vertices at the ends of sides that no other side runs back.
std::vector<std::uint32_t> open_vertices(const std::vector<std::uint32_t>& corner) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (std::size_t i = 0; i < corner.size(); ++i) {
        const std::uint32_t a = corner[i];
        const std::uint32_t b = corner[i % 3 == 2 ? i - 2 : i + 1];
        if (a == b)
            ++balance[{a, b}];
        else if (a < b)
            ++balance[{a, b}];
        else
            --balance[{b, a}];
    }
    std::vector<std::uint32_t> open;
    for (const auto& [side, count] : balance) {
        // A side that fell together cancels in pairs.
        const bool is_open = side.first == side.second ? count % 2 != 0 : count != 0;
        if (!is_open) continue;
        open.push_back(side.first);
        open.push_back(side.second);
    }
    std::ranges::sort(open);
    open.erase(std::unique(open.begin(), open.end()), open.end());
    return open;
}

}  // namespace

template <class Number, class Index>
bool MeshGLP<Number, Index>::Merge() {
    DisjointSets sets(NumVert());
    for (std::size_t i = 0; i < mergeFromVert.size(); ++i)
        sets.join(static_cast<std::uint32_t>(mergeFromVert[i]),
                  static_cast<std::uint32_t>(mergeToVert[i]));
    std::vector<std::uint32_t> corner;
    for (const Index v : triVerts) corner.push_back(sets.root(static_cast<std::uint32_t>(v)));
    std::vector<std::uint32_t> open = open_vertices(corner);
    if (open.empty()) return false;
    Box box;
    for (std::size_t v = 0; v < NumVert(); ++v) box.Union(vec3(GetVertPos(v)));
    const double near =
        std::max({static_cast<double>(tolerance), relative_epsilon * box.Scale(),
                  static_cast<double>(std::numeric_limits<Number>::epsilon()) * box.Scale()});
    const auto place = [&](std::uint32_t v) { return vec3(GetVertPos(v)); };
    std::ranges::sort(open, {}, [&](std::uint32_t v) { return place(v).x; });
    for (std::size_t i = 0; i < open.size(); ++i)
        for (std::size_t j = i + 1; j < open.size(); ++j) {
            const vec3 apart = place(open[j]) - place(open[i]);
            if (apart.x > near) break;
            if (la::maxelem(la::abs(apart)) <= near) sets.join(open[i], open[j]);
        }
    mergeFromVert.clear();
    mergeToVert.clear();
    for (std::uint32_t v = 0; v < NumVert(); ++v)
        if (const std::uint32_t root = sets.root(v); root != v) {
            mergeFromVert.push_back(static_cast<Index>(v));
            mergeToVert.push_back(static_cast<Index>(root));
        }
    return true;
}

template struct MeshGLP<float, std::uint32_t>;
template struct MeshGLP<double, std::uint64_t>;

}  // namespace manifold
