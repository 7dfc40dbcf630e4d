// SPDX-License-Identifier: Apache-2.0
#include "box_scene.h"

#include <trisect/brep/primitives/box.h>

#include <algorithm>
#include <array>
#include <span>

namespace trisect::app {
namespace {

/// The cells between all planes of a scene.
class Cells {
public:
    explicit Cells(const BoxScene& scene) {
        for (const auto& operand : scene.operands) {
            for (const Box& box : operand) {
                for (std::size_t k = 0; k < 3; ++k) {
                    planes_[k].push_back(box.low[k]);
                    planes_[k].push_back(box.high[k]);
                }
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            std::sort(planes_[k].begin(), planes_[k].end());
            planes_[k].erase(std::unique(planes_[k].begin(), planes_[k].end()), planes_[k].end());
            size_[k] = planes_[k].size() - 1;
            for (std::size_t i = 0; i < size_[k]; ++i)
                width_[k].push_back(plane(k, i + 1) - plane(k, i));
        }
        fill(scene);
    }

    [[nodiscard]] std::size_t size(std::size_t axis) const { return size_[axis]; }
    [[nodiscard]] ExactRational plane(std::size_t axis, std::size_t i) const {
        return ExactRational::from_double(planes_[axis][i]);
    }
    [[nodiscard]] const ExactRational& width(std::size_t axis, std::size_t i) const {
        return width_[axis][i];
    }
    /// False beyond the ends as well.
    [[nodiscard]] bool is_in(std::size_t i, std::size_t j, std::size_t k) const {
        return i < size_[0] && j < size_[1] && k < size_[2] && in_[index(i, j, k)] != 0;
    }

private:
    [[nodiscard]] std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
        return (i * size_[1] + j) * size_[2] + k;
    }

    void fill(const BoxScene& scene) {
        std::vector<std::uint32_t> in(size_[0] * size_[1] * size_[2], 0);
        std::vector<char> in_first(in.size(), 0);
        for (std::size_t o = 0; o < scene.operands.size(); ++o) {
            for (const Box& box : scene.operands[o]) {
                std::array<std::size_t, 3> from{}, to{};
                for (std::size_t k = 0; k < 3; ++k) {
                    from[k] = position(k, box.low[k]);
                    to[k] = position(k, box.high[k]);
                }
                for (std::size_t i = from[0]; i < to[0]; ++i)
                    for (std::size_t j = from[1]; j < to[1]; ++j)
                        for (std::size_t k = from[2]; k < to[2]; ++k) {
                            ++in[index(i, j, k)];
                            if (o == 0) in_first[index(i, j, k)] = 1;
                        }
            }
        }
        in_.resize(in.size());
        for (std::size_t c = 0; c < in.size(); ++c)
            in_[c] = is_result(scene, in[c], in_first[c] != 0) ? 1 : 0;
    }
    static bool is_result(const BoxScene& scene, std::uint32_t in, bool in_first) {
        switch (scene.operation) {
            case BooleanOperation::Union:
                return in > 0;
            case BooleanOperation::Intersection:
                return in == scene.operands.size();
            case BooleanOperation::Difference:
                return in_first && in == 1;
            default:
                return in % 2 == 1;
        }
    }
    [[nodiscard]] std::size_t position(std::size_t axis, double value) const {
        const auto found = std::lower_bound(planes_[axis].begin(), planes_[axis].end(), value);
        return static_cast<std::size_t>(found - planes_[axis].begin());
    }

    std::array<std::vector<double>, 3> planes_;
    std::array<std::vector<ExactRational>, 3> width_;
    std::array<std::size_t, 3> size_{};
    std::vector<char> in_;
};

void add_volume_and_area(const Cells& cells, CountedResult& out) {
    for (std::size_t i = 0; i <= cells.size(0); ++i) {
        for (std::size_t j = 0; j <= cells.size(1); ++j) {
            for (std::size_t k = 0; k <= cells.size(2); ++k) {
                const bool in = cells.is_in(i, j, k);
                if (in) out.volume += cells.width(0, i) * cells.width(1, j) * cells.width(2, k);
                // Against the neighbours below; the neighbour of the first cell is outside.
                if (j < cells.size(1) && k < cells.size(2) &&
                    in != (i > 0 && cells.is_in(i - 1, j, k)))
                    out.area += cells.width(1, j) * cells.width(2, k);
                if (i < cells.size(0) && k < cells.size(2) &&
                    in != (j > 0 && cells.is_in(i, j - 1, k)))
                    out.area += cells.width(0, i) * cells.width(2, k);
                if (i < cells.size(0) && j < cells.size(1) &&
                    in != (k > 0 && cells.is_in(i, j, k - 1)))
                    out.area += cells.width(0, i) * cells.width(1, j);
            }
        }
    }
}

/// Whether the open cell with the doubled position (a, b, c) lies in the closed set: an odd number
/// stands for an interval between two planes, an even one for a plane.
bool is_in_closure(const Cells& cells, std::size_t a, std::size_t b, std::size_t c) {
    const auto touches = [](std::size_t doubled, std::size_t cell) {
        return doubled == 2 * cell || doubled == 2 * cell + 1 || doubled == 2 * cell + 2;
    };
    for (std::size_t i = a / 2 == 0 ? 0 : a / 2 - 1; i <= a / 2; ++i)
        for (std::size_t j = b / 2 == 0 ? 0 : b / 2 - 1; j <= b / 2; ++j)
            for (std::size_t k = c / 2 == 0 ? 0 : c / 2 - 1; k <= c / 2; ++k)
                if (touches(a, i) && touches(b, j) && touches(c, k) && cells.is_in(i, j, k))
                    return true;
    return false;
}

std::int64_t euler_number(const Cells& cells) {
    std::int64_t sum = 0;
    for (std::size_t a = 0; a <= 2 * cells.size(0); ++a)
        for (std::size_t b = 0; b <= 2 * cells.size(1); ++b)
            for (std::size_t c = 0; c <= 2 * cells.size(2); ++c)
                if (is_in_closure(cells, a, b, c)) sum += (a + b + c) % 2 == 0 ? 1 : -1;
    return sum;
}

/// splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t next_random(std::uint64_t& state) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
}

void add_points(const Cells& cells, std::size_t points, std::uint64_t seed, CountedResult& out) {
    for (std::size_t n = 0; n < points; ++n) {
        CountedPoint p;
        std::array<std::size_t, 3> cell{};
        for (std::size_t k = 0; k < 3; ++k) {
            cell[k] = next_random(seed) % cells.size(k);
            p.at[k] = (cells.plane(k, cell[k]) + cells.plane(k, cell[k] + 1)).scaled(-1);
        }
        p.inside = cells.is_in(cell[0], cell[1], cell[2]);
        out.points.push_back(std::move(p));
    }
}

}  // namespace

PolygonMesh mesh_of(const std::vector<Box>& boxes) {
    PolygonMesh out;
    std::vector<std::uint32_t> loop;
    for (const Box& box : boxes) {
        const PolygonMesh one = make_box(box.low, box.high);
        const auto first = static_cast<std::uint32_t>(out.points.size());
        out.points.insert(out.points.end(), one.points.begin(), one.points.end());
        for (std::size_t f = 0; f < one.face_count(); ++f) {
            const auto face = one.face(f);
            // Triangles: some kernels read nothing else.
            for (std::size_t i = 2; i < face.size(); ++i)
                out.add_triangle(first + face[0], first + face[i - 1], first + face[i]);
        }
    }
    return out;
}

CountedResult count(const BoxScene& scene, std::size_t points, std::uint64_t seed) {
    const Cells cells(scene);
    CountedResult out;
    add_volume_and_area(cells, out);
    out.euler = euler_number(cells);
    add_points(cells, points, seed, out);
    return out;
}

}  // namespace trisect::app
