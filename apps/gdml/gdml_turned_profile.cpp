// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <trisect/brep/primitives/degrees.h>

#include "gdml_shape.h"

namespace trisect::app {
namespace {

constexpr double most_facets = 1U << 22;

/// Where corners are, without the end of a whole turn.
std::vector<double> angles_of(const GdmlTurn& turn, std::uint32_t facets) {
    std::vector<double> out;
    const bool is_whole = turn.extent >= 360;
    if (turn.sides != 0) {
        for (std::uint32_t i = 0; i < turn.sides + (is_whole ? 0 : 1); ++i)
            out.push_back(turn.start + turn.extent * i / turn.sides);
        return out;
    }
    const double step = 360.0 / facets;
    const double end = turn.start + turn.extent;
    if (!is_whole) out.push_back(turn.start);
    for (double k = std::ceil(turn.start / step - 1e-9);; ++k) {
        const double at = 360.0 * k / facets;
        if (at > end - (is_whole ? 1e-9 : 0)) break;
        if (is_whole || (at > turn.start && at < end)) out.push_back(at);
    }
    if (!is_whole) out.push_back(end);
    return out;
}

/// Corner k of the profile at each angle; one for all where it is on the axis.
class Rings {
public:
    Rings(PolygonMesh& mesh, const Outline& profile, const GdmlTurn& turn,
          const std::vector<double>& angles)
        : mesh_(mesh), profile_(profile), first_(profile.size()) {
        for (std::size_t k = 0; k < profile.size(); ++k) {
            first_[k] = static_cast<std::uint32_t>(mesh.points.size());
            const auto& [r, z] = profile[k];
            for (const double a : angles) {
                mesh.points.push_back(
                    {std::nearbyint(r * turn.scale_x * detail::cosine_of_degrees(a)) + 0.0,
                     std::nearbyint(r * turn.scale_y * detail::sine_of_degrees(a)) + 0.0, z});
                if (r == 0) break;
            }
        }
    }
    [[nodiscard]] std::uint32_t at(std::size_t k, std::size_t angle) const {
        return first_[k] + (profile_[k][0] == 0 ? 0 : static_cast<std::uint32_t>(angle));
    }
    /// What the side of the profile from corner k to corner l sweeps between two angles.
    void add_side(std::size_t k, std::size_t l, std::size_t from, std::size_t to) {
        const bool k_on_axis = profile_[k][0] == 0;
        const bool l_on_axis = profile_[l][0] == 0;
        if (k_on_axis && l_on_axis) return;
        if (k_on_axis)
            mesh_.add_triangle(at(k, from), at(l, to), at(l, from));
        else if (l_on_axis)
            mesh_.add_triangle(at(k, from), at(k, to), at(l, from));
        else
            add_quad(k, l, from, to);
    }

private:
    /// Cones have their corners rounded, and so are in triangles; the diagonal begins at the lower
    /// end whichever way the profile runs, so that two cones that fit have the same ones.
    void add_quad(std::size_t k, std::size_t l, std::size_t from, std::size_t to) {
        if (profile_[k][0] == profile_[l][0] || profile_[k][1] == profile_[l][1]) {
            const std::array<std::uint32_t, 4> side{at(k, from), at(k, to), at(l, to), at(l, from)};
            mesh_.add_face(side);
        } else if (profile_[k][1] < profile_[l][1]) {
            mesh_.add_triangle(at(k, from), at(k, to), at(l, to));
            mesh_.add_triangle(at(k, from), at(l, to), at(l, from));
        } else {
            mesh_.add_triangle(at(l, from), at(k, from), at(k, to));
            mesh_.add_triangle(at(l, from), at(k, to), at(l, to));
        }
    }

    PolygonMesh& mesh_;
    const Outline& profile_;
    std::vector<std::uint32_t> first_;
};

Outline without_repeats(const Outline& profile) {
    Outline out;
    for (const Point2d& p : profile)
        if (out.empty() || out.back() != p) out.push_back(p);
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
    return out;
}

}  // namespace

PolygonMesh turned_profile(const GdmlSource& source, const Outline& given, const GdmlTurn& turn) {
    const Outline profile = without_repeats(given);
    const std::vector<double> angles = angles_of(turn, source.facets);
    PolygonMesh mesh;
    if (profile.size() < 3) return mesh;
    if (static_cast<double>(angles.size()) * static_cast<double>(profile.size()) > most_facets)
        source.document.fail_limit(source.document.root(), "a shape with too many facets");
    Rings rings(mesh, profile, turn, angles);
    const bool is_whole = turn.extent >= 360;
    const std::size_t n = profile.size();
    const std::size_t steps = angles.size() - (is_whole ? 0 : 1);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < steps; ++i)
            rings.add_side(k, (k + 1) % n, i, (i + 1) % angles.size());
    if (!is_whole) {
        std::vector<std::uint32_t> begin(n);
        std::vector<std::uint32_t> end(n);
        for (std::size_t k = 0; k < n; ++k) {
            begin[k] = rings.at(k, 0);
            end[n - 1 - k] = rings.at(k, angles.size() - 1);
        }
        mesh.add_face(begin);
        mesh.add_face(end);
    }
    make_outward(mesh);
    return mesh;
}

}  // namespace trisect::app
