// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/placement.h>

#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trisect::detail {
namespace {

/// Turns normals by the cofactors of the map, which keep them at right angles to faces.
class NormalTurner {
public:
    explicit NormalTurner(const ExactAffine& placement) {
        const std::array<double, 12> m = placement.rows();
        const double sign = placement.orientation();
        for (std::size_t row = 0; row < 3; ++row) {
            const std::size_t a = 4 * ((row + 1) % 3);
            const std::size_t b = 4 * ((row + 2) % 3);
            for (std::size_t k = 0; k < 3; ++k)
                cofactors_[3 * row + k] = sign * (m[a + (k + 1) % 3] * m[b + (k + 2) % 3] -
                                                  m[a + (k + 2) % 3] * m[b + (k + 1) % 3]);
        }
    }

    /// Of the length that it has.
    void turn(std::span<double> n) const {
        std::array<double, 3> out{};
        for (std::size_t i = 0; i < 9; ++i) out[i / 3] += cofactors_[i] * n[i % 3];
        const double scale = std::hypot(n[0], n[1], n[2]) / std::hypot(out[0], out[1], out[2]);
        for (std::size_t k = 0; k < 3; ++k) n[k] = std::isfinite(scale) ? scale * out[k] : out[k];
    }

private:
    std::array<double, 9> cofactors_{};
};

}  // namespace

CornerProperties placed_properties(const CornerProperties& properties, const PolygonMesh& mesh,
                                   const ExactAffine& placement) {
    CornerProperties out = properties;
    if (out.width == 0 || placement.is_identity()) return out;
    if (const auto column = out.column_of(PropertyMeaning::Normal)) {
        const NormalTurner turner(placement);
        for (std::size_t at = *column; at < out.values.size(); at += out.width)
            turner.turn(std::span(out.values).subspan(at, 3));
    }
    if (placement.orientation() > 0) return out;
    // Corners after the first come the other way around; the numbers of each keep their order.
    const auto row = [&](std::size_t corner) {
        return out.values.begin() + static_cast<std::ptrdiff_t>(corner * out.width);
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::size_t a = mesh.face_begin[f] + 1;
        for (std::size_t b = mesh.face_begin[f + 1] - 1; a < b; ++a, --b)
            std::swap_ranges(row(a), row(a + 1), row(b));
    }
    return out;
}

void add_placed(ModelPart& part, const PolygonMesh& mesh, const ExactAffine& placement,
                ModelReport& report) {
    const std::size_t first_face = part.mesh.face_count();
    const std::size_t first_point = part.mesh.points.size();
    append(part.mesh, mesh);
    if (placement.is_identity()) return;
    for (std::size_t v = first_point; v < part.mesh.points.size(); ++v) {
        check_stop();
        const ExactAffine::Image image = placement.apply(part.mesh.points[v]);
        part.mesh.points[v] = image.point;
        report.rounded_vertices += image.move > 0 ? 1U : 0U;
        report.largest_move = std::max(report.largest_move, image.move);
    }
    if (placement.orientation() > 0) return;
    for (std::size_t f = first_face; f < part.mesh.face_count(); ++f) {
        const auto begin = part.mesh.corners.begin();
        std::reverse(begin + part.mesh.face_begin[f] + 1, begin + part.mesh.face_begin[f + 1]);
    }
}

}  // namespace trisect::detail
