// SPDX-License-Identifier: Apache-2.0
//
// A ring with bumps as binary STL, of any number of triangles:
//
//   bumpy_ring AROUND ACROSS TURN SHIFT FILE    2 * AROUND * ACROSS triangles, turned and moved
//
// Written row by row, so that it may be larger than memory.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <utility>
#include <vector>

namespace {

using FloatPoint = std::array<float, 3>;

struct Ring {
    int around;
    int across;
    double turn;
    double shift;

    [[nodiscard]] FloatPoint point(int i, int j) const {
        const double a = 2 * std::numbers::pi * (i % around) / around;
        const double b = 2 * std::numbers::pi * (j % across) / across;
        const double r = 10 + 0.8 * std::sin(23 * a) * std::cos(9 * b) +
                         0.15 * std::sin(311 * a) * std::sin(97 * b);
        const double x = (40 + r * std::cos(b)) * std::cos(a);
        const double y = (40 + r * std::cos(b)) * std::sin(a);
        const double z = r * std::sin(b);
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        return {static_cast<float>(x * c - z * s + shift), static_cast<float>(y + 0.37 * shift),
                static_cast<float>(x * s + z * c)};
    }
    [[nodiscard]] std::vector<FloatPoint> row(int i) const {
        std::vector<FloatPoint> out;
        for (int j = 0; j <= across; ++j) out.push_back(point(i, j));
        return out;
    }
};

template <class T>
void put(std::ofstream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_triangle(std::ofstream& out, const FloatPoint& a, const FloatPoint& b,
                  const FloatPoint& c) {
    put(out, FloatPoint{});
    put(out, a);
    put(out, b);
    put(out, c);
    put(out, std::uint16_t{0});
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 6) return 2;
    const Ring ring{std::atoi(argv[1]), std::atoi(argv[2]), std::atof(argv[3]), std::atof(argv[4])};
    std::ofstream out(argv[5], std::ios::binary);
    put(out, std::array<char, 80>{});
    put(out, static_cast<std::uint32_t>(2 * ring.around * ring.across));
    std::vector<FloatPoint> last = ring.row(0);
    for (int i = 0; i < ring.around; ++i) {
        std::vector<FloatPoint> next = ring.row(i + 1);
        for (std::size_t j = 0; j + 1 < last.size(); ++j) {
            put_triangle(out, last[j], next[j], next[j + 1]);
            put_triangle(out, last[j], next[j + 1], last[j + 1]);
        }
        last = std::move(next);
    }
    return out.flush() ? 0 : 1;
}
