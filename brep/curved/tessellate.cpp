// SPDX-License-Identifier: Apache-2.0
//
// The bound. Let L be linear on a triangle of the parameter plane with corners p_k, equal to the
// surface S there. At x = Σ λ_k p_k, by Taylor's theorem around x, with d_k = p_k - x,
//
//     S(x) - L(x) = -Σ λ_k H_k(d_k, d_k) / 2
//
// where H_k is a mean of the second derivatives between x and p_k. Magnitudes would add up what
// mostly cancels or is not there at the same place; so ranges of the
// derivatives are known for blocks of the patch: over a cell H = C + R with a constant
// vector-valued form C and a small rest. For C the sum is, exactly,
//
//     Σ_(i<j) λ_i λ_j C(p_i - p_j, p_i - p_j) / 2,
//
// the second derivatives along the three sides: a, b for the sides of a cell l1 × l2 and c for its
// diagonal give at most half the largest value of λ1 λ2 a + λ2 λ3 b + λ1 λ3 c. For the rest,
// numbers with mean 0 in a range of l1 have Σ λ_k du_k² <= l1² / 4, so it adds at most
//
//     (l1² |R_uu| + 2 l1 l2 |R_uv| + l2² |R_vv|) / 8.
//
// A cell takes the ranges of all blocks that it meets. S(x) and L(x) belong to each other, so this
// bounds the distance both ways. To it add what evaluation and rounding do to the
// corners.
//
// Numbers of cells. Along a common side the finer patch's number has to be a multiple of the
// coarser one's. Powers of two are, but waste up to half of the cells each way; so are 1, 3, 6, 12,
// 24 or 1, 5, 10, 20. The sequence that needs the fewest cells is taken, the same for all patches.

#include <trisect/brep/curved/tessellate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <trisect/brep/curved/control_net.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect {

namespace {

using detail::ControlNet;
using detail::Range;
using detail::SecondDerivatives;
using detail::SideCurve;
using detail::VectorRange;

constexpr std::uint64_t max_count = std::uint64_t{1} << 20;
constexpr std::uint64_t max_cells = std::uint64_t{1} << 26;

// The largest value of λ1 λ2 a + λ2 λ3 b + λ1 λ3 c for numbers λ >= 0 with sum 1, from above.
double largest_mean(double a, double b, double c) {
    const double most = std::max({a, b, c});
    if (!(most > 0)) return 0;
    a /= most;
    b /= most;
    c /= most;
    double r = 0.25;
    if (a < b + c && b < a + c && c < a + b)
        r = std::max(r, a * b * c / (2 * (a * b + b * c + c * a) - a * a - b * b - c * c));
    return r * most * (1 + 0x1p-30);
}

// A vector, and how far it may be off.
struct RoughVector {
    Point3d middle{};
    double radius = 0;

    explicit RoughVector(const VectorRange& x) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = 0.5 * x[k].lo + 0.5 * x[k].hi;
            const double half = std::max(x[k].hi - middle[k], middle[k] - x[k].lo);
            sum += half * half;
        }
        radius = std::sqrt(sum) * detail::surely_more;
    }
};

double length_of_sum(double a, const Point3d& x, double b, const Point3d& y, double c,
                     const Point3d& z) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double s = a * x[k] + b * y[k] + c * z[k];
        sum += s * s;
    }
    return std::sqrt(sum);
}

// Bounds on how far cells l1 × l2 are from the surface, for both ways to divide them.
struct CellDeviation {
    double rising = 0;   // diagonal from (0, 0) to (1, 1)
    double falling = 0;  // the other one

    static CellDeviation of(const SecondDerivatives& h, double l1, double l2) {
        const RoughVector uu(h.uu);
        const RoughVector uv(h.uv);
        const RoughVector vv(h.vv);
        const double p = l1 * l1;
        const double q = l2 * l2;
        const double m = 2 * l1 * l2;
        const double a = length_of_sum(p, uu.middle, 0, uv.middle, 0, vv.middle);
        const double b = length_of_sum(0, uu.middle, 0, uv.middle, q, vv.middle);
        const double twist = length_of_sum(0, uu.middle, m, uv.middle, 0, vv.middle);
        const double rest = (p * uu.radius + m * uv.radius + q * vv.radius) / 8;
        // Where a cell is a fan about its middle, spokes are half as long as the cell.
        const double spoke = 0.25 * (a + twist + b);
        const double fan = largest_mean(std::max(a, b), spoke, spoke);
        const auto with = [&](double sign) {
            const double c = length_of_sum(p, uu.middle, sign * m, uv.middle, q, vv.middle);
            return (1 + 0x1p-30) * (0.5 * std::max(fan, largest_mean(a, b, c)) + rest);
        };
        return {with(1), with(-1)};
    }
    [[nodiscard]] double least() const { return std::min(rising, falling); }
};

void include(VectorRange& all, const VectorRange& x) {
    for (std::size_t k = 0; k < 3; ++k)
        all[k] = {std::min(all[k].lo, x[k].lo), std::max(all[k].hi, x[k].hi)};
}

void include(SecondDerivatives& all, const SecondDerivatives& x) {
    include(all.uu, x.uu);
    include(all.uv, x.uv);
    include(all.vv, x.vv);
}

// How a patch is divided.
struct Division {
    std::uint64_t u = 1;
    std::uint64_t v = 1;
    bool is_rising = true;
    double deviation = HUGE_VAL;
    [[nodiscard]] std::uint64_t cells() const { return u * v; }
};

// Numbers of cells, each of which divides the next: 1, then the first one and its doubles.
class Sequence {
public:
    explicit Sequence(std::uint64_t first) {
        for (numbers_ = {1}; first <= max_count; first *= 2) numbers_.push_back(first);
    }
    [[nodiscard]] std::size_t size() const { return numbers_.size(); }
    [[nodiscard]] std::uint64_t operator[](std::size_t i) const { return numbers_[i]; }

private:
    std::vector<std::uint64_t> numbers_;
};

// The second derivatives of a patch, block by block.
class DerivativeGrid {
public:
    explicit DerivativeGrid(const ControlNet& net) {
        // Few blocks do where the derivatives hardly change.
        for (const int depth : {1, 5}) {
            side_ = std::size_t{1} << depth;
            blocks_.assign(side_ * side_, {});
            fill(net, depth, 0, 0, 1);
            if (is_fine()) break;
        }
    }

    // No cell is farther from the surface; gives up with an infinite one beyond the limit.
    [[nodiscard]] Division division(std::uint64_t u, std::uint64_t v, double limit) const {
        const std::vector<Span> rows = spans(u);
        const std::vector<Span> columns = spans(v);
        const double l1 = detail::surely_more / static_cast<double>(u);
        const double l2 = detail::surely_more / static_cast<double>(v);
        CellDeviation worst;
        for (const Span& row : rows)
            for (const Span& column : columns) {
                SecondDerivatives h = block(row.first, column.first);
                for (std::size_t i = row.first; i <= row.last; ++i)
                    for (std::size_t j = column.first; j <= column.last; ++j)
                        include(h, block(i, j));
                const CellDeviation d = CellDeviation::of(h, l1, l2);
                worst.rising = std::max(worst.rising, d.rising);
                worst.falling = std::max(worst.falling, d.falling);
                if (!(worst.least() <= limit)) return {u, v};
            }
        return {u, v, worst.rising <= worst.falling, worst.least()};
    }

    // The fewest cells within the deviation. \throw LimitError
    [[nodiscard]] Division choose(const Sequence& numbers, double deviation) const {
        Division best;
        std::size_t v = numbers.size() - 1;
        for (std::size_t u = 0; u < numbers.size(); ++u) {
            Division at = division(numbers[u], numbers[v], deviation);
            while (v > 0) {
                const Division coarser = division(numbers[u], numbers[v - 1], deviation);
                if (!(coarser.deviation <= deviation)) break;
                at = coarser;
                --v;
            }
            const bool is_better = !(best.deviation <= deviation) || at.cells() < best.cells();
            if (at.deviation <= deviation && is_better) best = at;
            if (best.deviation <= deviation && numbers[u] > best.cells()) break;
        }
        if (!(best.deviation <= deviation))
            throw LimitError("a patch would have to be divided more than 2^20 times one way");
        return best;
    }

private:
    struct Span {
        std::size_t first = 0;
        std::size_t last = 0;
    };

    [[nodiscard]] const SecondDerivatives& block(std::size_t i, std::size_t j) const {
        return blocks_[i * side_ + j];
    }

    void fill(const ControlNet& net, int depth, std::size_t i, std::size_t j, double scale) {
        if (depth == 0) {
            SecondDerivatives h = net.second_derivatives();
            for (VectorRange* x : {&h.uu, &h.uv, &h.vv})
                for (Range& r : *x) r = {scale * r.lo, scale * r.hi};
            blocks_[i * side_ + j] = h;
            return;
        }
        const auto [low, high] = net.halves_in_u();
        for (const std::size_t half : {0U, 1U}) {
            const auto [first, second] = (half == 0 ? low : high).halves_in_v();
            fill(first, depth - 1, 2 * i + half, 2 * j, 4 * scale);
            fill(second, depth - 1, 2 * i + half, 2 * j + 1, 4 * scale);
        }
    }

    [[nodiscard]] bool is_fine() const {
        SecondDerivatives all = blocks_.front();
        for (const SecondDerivatives& h : blocks_) include(all, h);
        const CellDeviation whole = CellDeviation::of(all, 1, 1);
        double finest = HUGE_VAL;
        for (const SecondDerivatives& h : blocks_)
            finest = std::min(finest, CellDeviation::of(h, 1, 1).least());
        return whole.least() <= 1.05 * finest;
    }

    // Ranges of blocks that cells meet, each once. Blocks begin at dyadic numbers, where corners
    // that are to be there are, exactly.
    [[nodiscard]] std::vector<Span> spans(std::uint64_t cells) const {
        std::vector<Span> r;
        const auto n = static_cast<std::uint64_t>(side_);
        for (std::uint64_t c = 0; c < cells;) {
            const std::uint64_t first = c * n / cells;
            const std::uint64_t last = ((c + 1) * n - 1) / cells;
            r.push_back({static_cast<std::size_t>(first), static_cast<std::size_t>(last)});
            // Cells within one block are all alike: on to the first that reaches beyond it.
            ++c;
            if (first == last) c = std::max(c, ((first + 1) * cells + n) / n - 1);
        }
        return r;
    }

    std::size_t side_ = 1;
    std::vector<SecondDerivatives> blocks_;
};

class Tessellator {
public:
    Tessellator(const CurvedBoundary& boundary, double deviation)
        : boundary_(boundary), deviation_(deviation) {
        double largest = 0;
        for (const BezierPatch& p : boundary.patches()) {
            nets_.emplace_back(p);
            for (const Point3d& c : p.points())
                for (const double x : c) largest = std::max(largest, std::abs(x));
        }
        int exponent = 0;
        (void)std::frexp(largest, &exponent);
        grid_ = std::ldexp(1, exponent - 44);
    }

    Tessellation run() {
        choose();
        side_vertices_.resize(nets_.size());
        for (std::uint32_t p = 0; p < nets_.size(); ++p)
            for (std::uint32_t k = 0; k < 4; ++k) make_side({p, k});
        for (std::uint32_t p = 0; p < nets_.size(); ++p) make_cells(p);
        double reached = 0;
        for (const Division& d : divisions_) reached = std::max(reached, d.deviation);
        out_.deviation = reached + vertex_error_;
        if (!(out_.deviation <= deviation_)) throw_too_fine();
        return std::move(out_);
    }

private:
    using Side = CurvedBoundary::Side;

    [[noreturn]] static void throw_too_fine() {
        throw UsageError("the deviation is finer than doubles can tell on this boundary");
    }

    void choose() {
        // Vertices are off by less than a thousandth of the deviation, or it is too fine.
        const double left = deviation_ * (1 - 0x1p-10);
        if (!(left > 0x1p10 * grid_)) throw_too_fine();
        std::vector<DerivativeGrid> grids;
        for (const ControlNet& net : nets_) grids.emplace_back(net);
        std::uint64_t fewest = 0;
        for (const std::uint64_t first : {2U, 3U, 5U, 7U, 9U}) {
            const Sequence numbers(first);
            std::vector<Division> divisions;
            std::uint64_t cells = 0;
            for (const DerivativeGrid& grid : grids) {
                divisions.push_back(grid.choose(numbers, left));
                cells += divisions.back().cells();
            }
            if (fewest != 0 && cells >= fewest) continue;
            fewest = cells;
            divisions_ = std::move(divisions);
        }
        if (fewest > max_cells) throw LimitError("a tessellation of more than 2^26 cells");
    }

    std::uint32_t add_vertex(const CertifiedPoint& p) {
        Point3d rounded{};
        double moved = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            rounded[k] = std::nearbyint(p.position[k] / grid_) * grid_ + 0.0;
            moved = std::max(moved, std::abs(rounded[k] - p.position[k]));
        }
        vertex_error_ = std::max(vertex_error_, 1.8 * (moved + p.error));
        out_.mesh.points.push_back(rounded);
        return static_cast<std::uint32_t>(out_.mesh.points.size() - 1);
    }
    // A corner of a patch is a control point, whatever curve leads there.
    std::uint32_t corner_vertex(const Point3d& p) {
        const auto [it, is_new] = corners_.try_emplace(p, 0);
        if (is_new) it->second = add_vertex({p, 0});
        return it->second;
    }

    [[nodiscard]] std::size_t own_cells(Side s) const {
        const Division& d = divisions_[s.patch];
        return static_cast<std::size_t>(s.number % 2 == 0 ? d.u : d.v);
    }
    void make_side(Side side) {
        std::vector<std::uint32_t>& vertices = side_vertices_[side.patch][side.number];
        if (!vertices.empty()) return;
        const SideCurve curve = detail::side_curve(boundary_.patches()[side.patch], side.number);
        if (boundary_.is_point(side)) {
            vertices.assign(own_cells(side) + 1, corner_vertex(curve.points.front()));
            return;
        }
        const Side partner = boundary_.partner(side);
        const std::size_t n = std::max(own_cells(side), own_cells(partner));
        const ControlNet net(curve.points.size() - 1, curve.points, curve.weights);
        vertices.push_back(corner_vertex(curve.points.front()));
        for (std::size_t k = 1; k < n; ++k)
            vertices.push_back(
                add_vertex(net.at(static_cast<double>(k) / static_cast<double>(n), 0)));
        vertices.push_back(corner_vertex(curve.points.back()));
        std::vector<std::uint32_t>& others = side_vertices_[partner.patch][partner.number];
        others.assign(vertices.rbegin(), vertices.rend());
    }

    // The vertices of one side of a cell: of those on the patch's side, a range.
    void append_side(std::uint32_t patch, std::uint32_t number, std::size_t cell,
                     std::vector<std::uint32_t>& loop) const {
        const auto& vertices = side_vertices_[patch][number];
        const std::size_t cells = own_cells({patch, number});
        const std::size_t steps = (vertices.size() - 1) / cells;
        for (std::size_t k = 0; k < steps; ++k) loop.push_back(vertices[cell * steps + k]);
    }

    void make_cells(std::uint32_t patch) {
        const auto nu = static_cast<std::size_t>(divisions_[patch].u);
        const auto nv = static_cast<std::size_t>(divisions_[patch].v);
        const auto at = [&](double i, double j) {
            return nets_[patch].at(i / static_cast<double>(nu), j / static_cast<double>(nv));
        };
        const auto first = static_cast<std::uint32_t>(out_.mesh.points.size());
        for (std::size_t i = 1; i < nu; ++i)
            for (std::size_t j = 1; j < nv; ++j)
                add_vertex(at(static_cast<double>(i), static_cast<double>(j)));
        const auto inner = [&](std::size_t i, std::size_t j) {
            return first + static_cast<std::uint32_t>((i - 1) * (nv - 1) + j - 1);
        };
        const auto& sides = side_vertices_[patch];
        const auto vertex = [&](std::size_t i, std::size_t j) {
            const auto on = [&](std::uint32_t number, std::size_t cell, std::size_t cells) {
                return sides[number][cell * ((sides[number].size() - 1) / cells)];
            };
            if (j == 0) return on(0, i, nu);
            if (i == nu) return on(1, j, nv);
            if (j == nv) return on(2, nu - i, nu);
            if (i == 0) return on(3, nv - j, nv);
            return inner(i, j);
        };
        std::vector<std::uint32_t> loop;
        for (std::size_t i = 0; i < nu; ++i)
            for (std::size_t j = 0; j < nv; ++j) {
                loop.clear();
                j == 0 ? append_side(patch, 0, i, loop) : loop.push_back(vertex(i, j));
                i + 1 == nu ? append_side(patch, 1, j, loop) : loop.push_back(vertex(i + 1, j));
                j + 1 == nv ? append_side(patch, 2, nu - 1 - i, loop)
                            : loop.push_back(vertex(i + 1, j + 1));
                i == 0 ? append_side(patch, 3, nv - 1 - j, loop) : loop.push_back(vertex(i, j + 1));
                if (loop.size() == 4) {
                    add_quadrangle(patch, loop);
                    continue;
                }
                const std::uint32_t middle =
                    add_vertex(at(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5));
                for (std::size_t k = 0; k < loop.size(); ++k)
                    add_triangle(patch, middle, loop[k], loop[(k + 1) % loop.size()]);
            }
    }

    // Along the diagonal that was chosen for the patch.
    void add_quadrangle(std::uint32_t patch, const std::vector<std::uint32_t>& q) {
        const std::size_t s = divisions_[patch].is_rising ? 0 : 1;
        add_triangle(patch, q[s], q[s + 1], q[s + 2]);
        add_triangle(patch, q[s], q[s + 2], q[(s + 3) % 4]);
    }
    void add_triangle(std::uint32_t patch, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a == b || b == c || c == a) return;  // at a point
        out_.mesh.add_triangle(a, b, c);
        out_.patch_of_face.push_back(patch);
    }

    const CurvedBoundary& boundary_;
    double deviation_;
    double grid_ = 0;
    std::vector<ControlNet> nets_;
    std::vector<Division> divisions_;
    std::vector<std::array<std::vector<std::uint32_t>, 4>> side_vertices_;
    std::map<Point3d, std::uint32_t> corners_;
    double vertex_error_ = 0;
    Tessellation out_;
};

}  // namespace

Tessellation tessellate(const CurvedBoundary& boundary, double deviation) {
    if (!(deviation > 0 && std::isfinite(deviation)))
        throw UsageError("the deviation of a tessellation must be a positive number");
    return Tessellator(boundary, deviation).run();
}

}  // namespace trisect
