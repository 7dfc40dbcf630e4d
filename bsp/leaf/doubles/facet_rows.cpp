// SPDX-License-Identifier: Apache-2.0
//
// In a leaf of many operands most pairs of facets whose boxes meet are parted by one of the two
// supports, and nearly always by much. Single precision finds that for four facets with a few
// dozen instructions. Doubles look at what is left.
//
// Bounds, with u = 2^-24. The plane in doubles has a normal n and a bound (filtered_facets.h); the
// bound covers what n is off. Scaled by s it becomes single: components, coordinates and
// products are off by a factor of 1 + u each, the two sums above a product by another two. So a
// value is off by less than 5.1 u times the sum of |s n_k p_k|, and 3.1 u times |s n · origin|.
// Both sums are at most that of |s n_k| times the leaf's extent, since all points and the origin
// are within it. That makes 8.2 u; 16 u is taken, which also is far more than what vanishes below
// the smallest number.
//
// A line from a in the direction d passes a triangle where the determinants of d and two corners,
// both taken from a, have different signs. Differences of coordinates are at most 1 and off by 3 u,
// besides errors e of the segment's ends: d by 2 e, corners by e. The six products of a determinant
// are off by 9.1 u + 4.1 e each for that and by 5.1 u for rounding, 86 u + 25 e in all; 128 u + 32
// e is taken.

#include <trisect/bsp/leaf/doubles/facet_rows.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/kernel/support/four_floats.h>
#include <trisect/kernel/support/wide_clones.h>

namespace trisect::detail {

namespace {

// Rounded upwards. \pre x >= 0
float above(double x) { return static_cast<float>(x * (1 + 0x1p-22)); }

std::array<float, 3> single(const Vector3& p, double scale) {
    return {static_cast<float>(scale * p[0]), static_cast<float>(scale * p[1]),
            static_cast<float>(scale * p[2])};
}

template <class Number>
FourFloats value(const std::array<FourFloats, 3>& normal, const FourFloats& offset,
                 const std::array<Number, 3>& p) {
    return (normal[0] * FourFloats(p[0]) + normal[1] * FourFloats(p[1])) +
           (normal[2] * FourFloats(p[2]) - offset);
}

// The facets that have all points on one side of a plane; one plane and four of each point, or four
// planes and one of each.
template <class Points>
unsigned off(const std::array<FourFloats, 3>& normal, const FourFloats& offset,
             const FourFloats& bound, const Points& points) {
    FourFloats least = value(normal, offset, points[0]);
    FourFloats most = least;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const FourFloats v = value(normal, offset, points[i]);
        least = smaller(least, v);
        most = larger(most, v);
    }
    return greater(least, bound) | greater(FourFloats(0) - bound, most);
}

template <class Number>
std::array<FourFloats, 3> fours(const std::array<Number, 3>& v) {
    return {FourFloats(v[0]), FourFloats(v[1]), FourFloats(v[2])};
}

using Fours = std::array<FourFloats, 3>;

}  // namespace

void FacetRows::start(const Vector3& extent) {
    size_ = 0;
    rows_.clear();
    singles_.clear();
    int exponent = 0;
    std::frexp(std::max({extent[0], extent[1], extent[2]}), &exponent);
    scale_ = std::ldexp(1.0, -exponent);
    for (std::size_t k = 0; k < 3; ++k) extent_[k] = scale_ * extent[k];
}

void FacetRows::add(const std::array<Vector3, 3>& corners, const FilteredPlane& plane) {
    alignas(16) std::array<Four, 3> singles;
    for (std::size_t c = 0; c < 3; ++c) singles[c] = single_of(corners[c]);
    add(singles, plane);
}

void FacetRows::add(const std::array<Four, 3>& corners, const FilteredPlane& plane) {
    const std::size_t i = size_++ % 4;
    if (i == 0) rows_.emplace_back();
    const PlaneInSingles p = in_singles(plane);
    Row& r = rows_.back();
    Single& s = singles_.emplace_back();
    // A power of two, so that it does not matter what was rounded before.
    const FourFloats scale(static_cast<float>(scale_));
    for (std::size_t c = 0; c < 3; ++c) {
        s.numbers[c] = (FourFloats(corners[c]) * scale).numbers();
        for (std::size_t k = 0; k < 3; ++k) r.corners[c][k][i] = s.numbers[c][k];
        r.normal[c][i] = s.numbers[c][3] = p.normal[c];
    }
    r.offset[i] = p.offset;
    r.bound[i] = p.bound;
    s.numbers[3] = {p.offset, p.bound, p.tilt, 0};
}

FacetRows::PlaneInSingles FacetRows::in_singles(const FilteredPlane& plane) const {
    const Vector3& n = plane.normal;
    const double largest = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
    PlaneInSingles out;
    if (!(largest > 0)) {
        out.bound = std::numeric_limits<float>::infinity();
        return out;
    }
    // A product with it is off by a last place more than a quotient, of doubles.
    const double per_largest = 1 / largest;
    double offset = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double component = n[k] * per_largest;
        out.normal[k] = static_cast<float>(component);
        offset += component * (scale_ * plane.origin[k]);
        sum += std::fabs(component) * extent_[k];
    }
    out.offset = static_cast<float>(offset);
    out.bound = above(0x1p-20 * sum + plane.bound * per_largest * scale_);
    out.tilt = above(0x1p-22 + 0x1p-50 * plane.slope * per_largest);
    return out;
}

FacetRows::Probe FacetRows::probe(std::size_t facet) const {
    const Row& r = rows_[facet / 4];
    const std::size_t i = facet % 4;
    Probe out;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) out.corners[c][k].fill(r.corners[c][k][i]);
    for (std::size_t k = 0; k < 3; ++k) out.normal[k].fill(r.normal[k][i]);
    out.offset.fill(r.offset[i]);
    out.bound.fill(r.bound[i]);
    return out;
}

TRISECT_WIDE_CLONES
unsigned FacetRows::parted(std::size_t row, const Probe& probe, unsigned among) const {
    const Row& r = rows_[row];
    const unsigned beside =
        off(fours(probe.normal), FourFloats(probe.offset), FourFloats(probe.bound), r.corners);
    if ((among & ~beside) == 0) return beside;
    return beside | off(fours(r.normal), FourFloats(r.offset), FourFloats(r.bound), probe.corners);
}

FacetRows::Segment FacetRows::segment(const Approximation& a, const Approximation& b) const {
    return {{single(a.c, scale_), single(b.c, scale_)}, above(scale_ * std::max(a.error, b.error))};
}

TRISECT_WIDE_CLONES
unsigned FacetRows::parted(std::size_t row, const Segment& segment, unsigned among) const {
    const Row& r = rows_[row];
    // No component of a normal is above 1, nor by much above it before it was rounded.
    const unsigned beside = off(fours(r.normal), FourFloats(r.offset),
                                FourFloats(r.bound) + FourFloats(4 * segment.error), segment.ends);
    if ((among & ~beside) == 0) return beside;
    const Fours a = fours(segment.ends[0]);
    const Fours d = minus(fours(segment.ends[1]), a);
    const std::array<Fours, 3> corners{minus(fours(r.corners[0]), a), minus(fours(r.corners[1]), a),
                                       minus(fours(r.corners[2]), a)};
    const FourFloats x = dot(cross(d, corners[0]), corners[1]);
    const FourFloats y = dot(cross(d, corners[1]), corners[2]);
    const FourFloats z = dot(cross(d, corners[2]), corners[0]);
    const FourFloats bound(0x1p-17F + 32 * segment.error);
    return beside | (greater(larger(larger(x, y), z), bound) &
                     greater(FourFloats(0) - bound, smaller(smaller(x, y), z)));
}

}  // namespace trisect::detail
