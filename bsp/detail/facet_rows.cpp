// SPDX-License-Identifier: Apache-2.0
//
// In a leaf of many operands most pairs of facets whose boxes meet are parted by one of the two
// supports, and nearly always by much. Single precision finds that for four facets with a few
// dozen instructions. Doubles look at what is left.
//
// Bounds, with u = 2^-24. The plane in doubles has a normal n and a bound (plain_facets.h); the
// bound covers what n is off. Scaled by s it becomes single: components, coordinates and products
// are off by a factor of 1 + u each, the two sums above a product by another two. So a value is off
// by less than 5.1 u times the sum of |s n_k p_k|, and 3.1 u times |s n · origin|. Both sums are at
// most that of |s n_k| times the leaf's extent, since all points and the origin are within it. That
// makes 8.2 u; 16 u is taken. The largest |s n_k| is 1 and extents are at least 1, so what may
// vanish below the smallest number does not count.

#include <trisect/bsp/detail/facet_rows.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/detail/four_floats.h>

namespace trisect::detail {

namespace {

// Rounded upwards. \pre x >= 0
float above(double x) { return static_cast<float>(x * (1 + 0x1p-22)); }

std::array<float, 3> single(const Vector3& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
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
    return beyond(least, most, bound);
}

template <class Number>
std::array<FourFloats, 3> fours(const std::array<Number, 3>& v) {
    return {FourFloats(v[0]), FourFloats(v[1]), FourFloats(v[2])};
}

}  // namespace

void FacetRows::add(const PlainFacet& f, const Vector3& extent) {
    const std::size_t i = size_++ % 4;
    if (i == 0) rows_.emplace_back();
    Row& r = rows_.back();
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k)
            r.corners[c][k][i] = static_cast<float>(f.corners[c][k]);
    const Vector3& n = f.plane.normal;
    const double largest = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
    if (!(largest > 0)) {
        r.bound[i] = std::numeric_limits<float>::infinity();
        return;
    }
    const double scale = 1 / largest;
    double offset = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double component = n[k] * scale;
        r.normal[k][i] = static_cast<float>(component);
        offset += component * f.plane.origin[k];
        sum += std::fabs(component) * extent[k];
    }
    r.offset[i] = static_cast<float>(offset);
    r.bound[i] = above(0x1p-20 * sum + f.plane.bound * scale);
}

FacetRows::Probe FacetRows::probe(std::size_t facet) const {
    const Row& r = rows_[facet / 4];
    const std::size_t i = facet % 4;
    Probe out;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) out.corners[c][k] = r.corners[c][k][i];
    for (std::size_t k = 0; k < 3; ++k) out.normal[k] = r.normal[k][i];
    out.offset = r.offset[i];
    out.bound = r.bound[i];
    return out;
}

unsigned FacetRows::parted(std::size_t row, const Probe& probe) const {
    const Row& r = rows_[row];
    return off(fours(r.normal), FourFloats(r.offset), FourFloats(r.bound), probe.corners) |
           off(fours(probe.normal), FourFloats(probe.offset), FourFloats(probe.bound), r.corners);
}

FacetRows::Segment FacetRows::segment(const Approximation& a, const Approximation& b) {
    // No component of a normal is above 1, nor by much above it before it was rounded.
    return {{single(a.c), single(b.c)}, above(4 * std::max(a.error, b.error))};
}

unsigned FacetRows::parted(std::size_t row, const Segment& segment) const {
    const Row& r = rows_[row];
    return off(fours(r.normal), FourFloats(r.offset),
               FourFloats(r.bound) + FourFloats(segment.error), segment.ends);
}

}  // namespace trisect::detail
