// SPDX-License-Identifier: Apache-2.0
//
// ObbPose: overlap tests between boxes of two trees under a pose.
// Four pairs are tested at a time, in single precision. Pairs reported as separated are
// separated; the others may be.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/obb_tree.h>
#include <trisect/kernel/support/float4.h>

namespace trisect::detail {

/// The map from the units of tree B to those of tree A, prepared. The derivation of `margin` is in
/// obb_pose.cpp.
class ObbPose {
public:
    /// A vector for each of four lanes, in units of A, of length at most 1 + 2^-20.
    using Directions = std::array<Float4, 3>;

    /// \pre both trees have boxes. `sweep`: every point of B may be that far, in lattice units of
    /// A, from where the map takes it (a solid that moves between queries).
    ObbPose(const ObbTree& a, const ObbTree& b, const ApproximateMap& b_to_a, double sweep = 0);

    /// Certainly no box of one meets a box of the other.
    [[nodiscard]] bool is_apart() const { return apart_; }
    /// A lower bound of the distance of what is in the boxes, in units of A, by a ball around each.
    [[nodiscard]] double clearance() const { return clearance_; }
    /// Bit i: box a and lane i of node b may meet.
    [[nodiscard]] unsigned overlaps(const OrientedBox& a, const ObbNode& b) const {
        return rigid_ ? may_meet<true>(lanes_of(a, b)) : may_meet<false>(lanes_of(a, b));
    }
    /// Bit i: lane i of node a and box b may meet.
    [[nodiscard]] unsigned overlaps(const ObbNode& a, const OrientedBox& b) const {
        return rigid_ ? may_meet<true>(lanes_of(a, b)) : may_meet<false>(lanes_of(a, b));
    }
    /// A lower bound of the distance of box a from each lane of node b, in units of A; positive
    /// wherever `overlaps` finds boxes apart. For lanes that are not used it means nothing.
    [[nodiscard]] Float4 gaps(const OrientedBox& a, const ObbNode& b) const {
        return gap(lanes_of(a, b), false);
    }
    [[nodiscard]] Float4 gaps(const ObbNode& a, const OrientedBox& b) const {
        return gap(lanes_of(a, b), false);
    }
    /// The best of such bounds that the normals of both boxes and the way between their closest
    /// points, or points near these, give. Tighter where edges or corners are nearest.
    [[nodiscard]] Float4 best_gaps(const OrientedBox& a, const ObbNode& b) const {
        return gap(lanes_of(a, b), true);
    }
    [[nodiscard]] Float4 best_gaps(const ObbNode& a, const OrientedBox& b) const {
        return gap(lanes_of(a, b), true);
    }
    /// A lower bound for each lane as above, positive wherever `overlaps` finds boxes apart, and a
    /// direction from A to B along which it holds: one of the fifteen axes. Of boxes that overlap
    /// any direction. Far from each other they are farther than this says.
    template <class BoxesA, class BoxesB>
    [[nodiscard]] Float4 gaps(const BoxesA& a, const BoxesB& b, Directions& along) const;
    /// Bound on how far any point below a box of B is from where another pose of the same trees
    /// puts it, in units of A.
    [[nodiscard]] double displacement_from(const ObbPose& other) const;
    /// Bound on the norm of the difference of the linear parts, in units of A for a unit of B.
    [[nodiscard]] double turn_from(const ObbPose& other) const;
    /// How many units of A one unit of B is (at most, for maps that stretch unevenly).
    [[nodiscard]] float scale() const { return scale_; }
    /// Whether the map is a similarity, as far as floats decide.
    [[nodiscard]] bool is_rigid() const { return rigid_; }

    // The map in floats, as tests of planes need it (separating_planes.h).
    [[nodiscard]] float turned(std::size_t i, std::size_t j) const { return m_[i][j]; }
    [[nodiscard]] float way(std::size_t i) const { return t_[i]; }
    [[nodiscard]] float margin() const { return margin_; }

private:
    // Boxes in the frame of box A, the axes of which are the coordinate axes there.
    struct Lanes {
        std::array<std::array<Float4, 3>, 3> r;  // [i][j]: component i of axis j of B
        std::array<Float4, 3> t;                 // from the centre of A to that of B
        std::array<Float4, 3> a;                 // halves
        std::array<Float4, 3> b;
    };
    [[nodiscard]] Lanes lanes_of(const OrientedBox& a, const ObbNode& b) const;
    [[nodiscard]] Lanes lanes_of(const ObbNode& a, const OrientedBox& b) const;
    [[nodiscard]] Float4 margin_of(const Lanes& l) const;
    // The most of some gaps.
    struct Most {
        Float4 most = all_lanes(-std::numeric_limits<float>::infinity());
        void offer(Float4 g, std::int32_t) { most = larger(g, most); }
        [[nodiscard]] Float4 gap() const { return most; }
    };
    // And the number of the axis in the last four bits, towards 0 from the gap: A's normals 0 to 2,
    // B's 3 to 5, products 6 + 3 i + j. What is no number is not taken.
    struct MostAndAxis {
        Float4 most = all_lanes(-std::numeric_limits<float>::infinity());
        void offer(Float4 g, std::int32_t number) {
            const Mask4 numbered =
                (reinterpret_cast<Mask4>(g) & ~last_bits) | Mask4{number, number, number, number};
            most = larger(reinterpret_cast<Float4>(numbered), most);
        }
        [[nodiscard]] Float4 gap() const {
            return reinterpret_cast<Float4>(reinterpret_cast<Mask4>(most) & ~last_bits);
        }
        [[nodiscard]] Mask4 axis() const { return reinterpret_cast<Mask4>(most) & last_bits; }
        static constexpr Mask4 last_bits{15, 15, 15, 15};
    };
    template <bool Rigid, class Gap>
    void offer_normals(const Lanes& l, Float4 margin, Gap& best) const;
    template <class Gap>
    void offer_products(const Lanes& l, Float4 margin, Gap& best) const;
    template <class Gap>
    void offer_axes(const Lanes& l, Float4 margin, Gap& best) const;
    void offer_direction(const Lanes& l, const std::array<Float4, 3>& n, Float4 margin,
                         Most& best) const;
    void offer_closest(const Lanes& l, Float4 margin, Most& best) const;
    [[nodiscard]] static Directions directions(const Lanes& l, Mask4 axis);
    template <bool Rigid>
    [[nodiscard]] unsigned may_meet(const Lanes& l) const;
    [[nodiscard]] double stretch_from(const ObbPose& other) const;
    [[nodiscard]] Float4 gap(const Lanes& l, bool by_closest) const;

    std::array<std::array<float, 3>, 3> m_{};  // divided by scale
    std::array<float, 3> t_{};
    std::array<std::array<double, 3>, 3> matrix_{};
    std::array<double, 3> way_{};
    double clearance_ = 0;
    double matrix_error_ = 0;  // of an entry of the matrix
    double inexact_ = 0;  // bound on the distance of a point of B from where these doubles put it
    double radius_ = 0;   // of what is in B's boxes, in its units
    float scale_ = 1;
    float margin_ = 0;
    bool rigid_ = true;
    bool mirrors_ = false;
    bool apart_ = false;
};

inline Float4 ObbPose::margin_of(const Lanes& l) const {
    return all_lanes(margin_) + all_lanes(0x1p-18F) * ((l.b[0] + l.b[1]) + l.b[2]);
}

// How far the boxes are from each other along the six normals: the most, negative when they overlap
// along all of them.
template <bool Rigid, class Gap>
void ObbPose::offer_normals(const Lanes& l, Float4 margin, Gap& best) const {
    const auto& r = l.r;
    const auto& t = l.t;
    for (std::size_t i = 0; i < 3; ++i) {
        const Float4 reach =
            (((l.a[i] + margin) + magnitude(r[i][0]) * l.b[0]) + magnitude(r[i][1]) * l.b[1]) +
            magnitude(r[i][2]) * l.b[2];
        best.offer(magnitude(t[i]) - reach, static_cast<std::int32_t>(i));
    }
    for (std::size_t j = 0; j < 3; ++j) {
        const Float4 along = (t[0] * r[0][j] + t[1] * r[1][j]) + t[2] * r[2][j];
        Float4 reach = ((margin + magnitude(r[0][j]) * l.a[0]) + magnitude(r[1][j]) * l.a[1]) +
                       magnitude(r[2][j]) * l.a[2];
        if constexpr (Rigid) {
            reach += l.b[j];
        } else {
            for (std::size_t k = 0; k < 3; ++k)
                reach +=
                    l.b[k] * magnitude((r[0][k] * r[0][j] + r[1][k] * r[1][j]) + r[2][k] * r[2][j]);
        }
        best.offer(magnitude(along) - reach, static_cast<std::int32_t>(3 + j));
    }
}

// The same along the products of an edge of A and an edge of B. Of rigid maps.
template <class Gap>
void ObbPose::offer_products(const Lanes& l, Float4 margin, Gap& best) const {
    const auto& r = l.r;
    const auto& t = l.t;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t i1 = (i + 1) % 3;
        const std::size_t i2 = (i + 2) % 3;
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t j1 = (j + 1) % 3;
            const std::size_t j2 = (j + 2) % 3;
            const Float4 along = t[i2] * r[i1][j] - t[i1] * r[i2][j];
            const Float4 reach =
                (((margin + l.a[i1] * magnitude(r[i2][j])) + l.a[i2] * magnitude(r[i1][j])) +
                 l.b[j1] * magnitude(r[i][j2])) +
                l.b[j2] * magnitude(r[i][j1]);
            best.offer(magnitude(along) - reach, static_cast<std::int32_t>(6 + 3 * i + j));
        }
    }
}

// The same along a vector of any length that is not 0.
inline void ObbPose::offer_direction(const Lanes& l, const std::array<Float4, 3>& n, Float4 margin,
                                     Most& best) const {
    const auto& r = l.r;
    const auto& t = l.t;
    const Float4 square = (n[0] * n[0] + n[1] * n[1]) + n[2] * n[2];
    Float4 across =
        (l.a[0] * magnitude(n[0]) + l.a[1] * magnitude(n[1])) + l.a[2] * magnitude(n[2]);
    for (std::size_t j = 0; j < 3; ++j)
        across += l.b[j] * magnitude((n[0] * r[0][j] + n[1] * r[1][j]) + n[2] * r[2][j]);
    const Float4 along = (n[0] * t[0] + n[1] * t[1]) + n[2] * t[2];
    best.offer((along - across) / larger(square_root(square), all_lanes(1e-30F)) - margin, 15);
}

// From the centre of B to the nearest point of A, from there to that of B, and back: two boxes that
// are small beside their distance are then nearly at their closest points. More rounds find more
// for one pair in a hundred.
inline void ObbPose::offer_closest(const Lanes& l, Float4 margin, Most& best) const {
    const auto clamped = [](Float4 v, Float4 h) { return larger(-larger(-v, -h), -h); };
    std::array<Float4, 3> way{};
    for (std::size_t k = 0; k < 3; ++k) way[k] = clamped(l.t[k], l.a[k]) - l.t[k];
    std::array<Float4, 3> p = l.t;
    for (std::size_t j = 0; j < 3; ++j) {
        const Float4 s =
            clamped((way[0] * l.r[0][j] + way[1] * l.r[1][j]) + way[2] * l.r[2][j], l.b[j]);
        for (std::size_t k = 0; k < 3; ++k) p[k] += s * l.r[k][j];
    }
    for (std::size_t k = 0; k < 3; ++k) p[k] -= clamped(p[k], l.a[k]);
    offer_direction(l, p, margin, best);
}

// A difference of two floats is positive exactly when one is the larger one.
template <bool Rigid>
unsigned ObbPose::may_meet(const Lanes& l) const {
    const Float4 margin = margin_of(l);
    Most normals;
    offer_normals<Rigid>(l, margin, normals);
    const unsigned apart = bits_of(normals.gap() > all_lanes(0));
    if (apart == 15 || !Rigid) return ~apart & 15U;
    Most products;
    offer_products(l, margin, products);
    return ~(apart | bits_of(products.gap() > all_lanes(0))) & 15U;
}

// Products where the normals do not part all lanes.
template <class Gap>
void ObbPose::offer_axes(const Lanes& l, Float4 margin, Gap& best) const {
    if (rigid_)
        offer_normals<true>(l, margin, best);
    else
        offer_normals<false>(l, margin, best);
    if (rigid_ && bits_of(best.gap() > all_lanes(0)) != 15) offer_products(l, margin, best);
}

inline Float4 ObbPose::gap(const Lanes& l, bool by_closest) const {
    const Float4 margin = margin_of(l);
    Most best;
    offer_axes(l, margin, best);
    if (by_closest)
        offer_closest(l, margin, best);
    else  // the line of centres, the best direction for boxes far apart
        offer_direction(l, l.t, margin, best);
    return larger(best.gap(), all_lanes(0)) * all_lanes(1 - 0x1p-18F);
}

// In the frame of box A. Without branches: every lane has another axis.
inline ObbPose::Directions ObbPose::directions(const Lanes& l, Mask4 axis) {
    constexpr std::size_t zero = 0;
    constexpr std::size_t one = 1;
    constexpr auto r = [](std::size_t i, std::size_t j) { return 2 + 3 * i + j; };
    constexpr auto minus_r = [](std::size_t i, std::size_t j) { return 11 + 3 * i + j; };
    // For each axis the places of its components in `all`.
    constexpr auto places = [=] {
        std::array<std::array<std::uint8_t, 3>, 15> p{};
        const auto set = [&p](std::size_t n, std::size_t k, std::size_t place) {
            p[n][k] = static_cast<std::uint8_t>(place);
        };
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) set(i, k, i == k ? one : zero);
            for (std::size_t k = 0; k < 3; ++k) set(3 + i, k, r(k, i));
            for (std::size_t j = 0; j < 3; ++j) {
                set(6 + 3 * i + j, i, zero);
                set(6 + 3 * i + j, (i + 1) % 3, minus_r((i + 2) % 3, j));
                set(6 + 3 * i + j, (i + 2) % 3, r((i + 1) % 3, j));
            }
        }
        return p;
    }();
    std::array<Float4, 20> all;
    all[zero] = all_lanes(0);
    all[one] = all_lanes(1);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            all[r(i, j)] = l.r[i][j];
            all[minus_r(i, j)] = -l.r[i][j];
        }
    }
    const auto place = [&](std::size_t k) { return places[static_cast<std::size_t>(axis[k])]; };
    const std::array<std::uint8_t, 3> p0 = place(0);
    const std::array<std::uint8_t, 3> p1 = place(1);
    const std::array<std::uint8_t, 3> p2 = place(2);
    const std::array<std::uint8_t, 3> p3 = place(3);
    Directions d;
    for (std::size_t i = 0; i < 3; ++i)
        d[i] = Float4{all[p0[i]][0], all[p1[i]][1], all[p2[i]][2], all[p3[i]][3]};
    return d;
}

namespace obb_lanes {
// A number of one box for four lanes, or of four.
inline Float4 of(float v) { return all_lanes(v); }
inline Float4 of(Float4 v) { return v; }
template <class Vector>
Float4 product(const std::array<Float4, 3>& v, const Vector& w) {
    return (v[0] * of(w[0]) + v[1] * of(w[1])) + v[2] * of(w[2]);
}
}  // namespace obb_lanes

template <class BoxesA, class BoxesB>
Float4 ObbPose::gaps(const BoxesA& a, const BoxesB& b, Directions& along) const {
    const Lanes l = lanes_of(a, b);
    MostAndAxis best;
    offer_axes(l, margin_of(l), best);
    const Directions d = directions(l, best.axis());
    // Towards B. Products are shorter than 1, and so are gaps along them.
    const Mask4 back = obb_lanes::product(d, l.t) < all_lanes(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const Float4 c = (d[0] * obb_lanes::of(a.axis[0][k]) + d[1] * obb_lanes::of(a.axis[1][k])) +
                         d[2] * obb_lanes::of(a.axis[2][k]);
        along[k] = back ? -c : c;
    }
    return larger(best.gap(), all_lanes(0)) * all_lanes(1 - 0x1p-18F);
}

inline ObbPose::Lanes ObbPose::lanes_of(const OrientedBox& a, const ObbNode& b) const {
    // Rows of A's axes times the map, and the way from its centre to the image of B's origin.
    std::array<std::array<float, 3>, 3> p{};
    std::array<float, 3> from{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            p[i][j] = (a.axis[i][0] * m_[0][j] + a.axis[i][1] * m_[1][j]) + a.axis[i][2] * m_[2][j];
        from[i] = (a.axis[i][0] * (t_[0] - a.center[0]) + a.axis[i][1] * (t_[1] - a.center[1])) +
                  a.axis[i][2] * (t_[2] - a.center[2]);
    }
    Lanes l;
    const Float4 scale = all_lanes(scale_);
    for (std::size_t i = 0; i < 3; ++i) {
        const Float4 p0 = all_lanes(p[i][0]);
        const Float4 p1 = all_lanes(p[i][1]);
        const Float4 p2 = all_lanes(p[i][2]);
        for (std::size_t j = 0; j < 3; ++j)
            l.r[i][j] = (p0 * b.axis[j][0] + p1 * b.axis[j][1]) + p2 * b.axis[j][2];
        l.t[i] =
            scale * ((p0 * b.center[0] + p1 * b.center[1]) + p2 * b.center[2]) + all_lanes(from[i]);
        l.a[i] = all_lanes(a.half[i]);
        l.b[i] = scale * b.half[i];
    }
    return l;
}

inline ObbPose::Lanes ObbPose::lanes_of(const ObbNode& a, const OrientedBox& b) const {
    std::array<std::array<float, 3>, 3> p{};  // [k][j]: component k of the image of B's axis j
    std::array<float, 3> center{};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j)
            p[k][j] = (m_[k][0] * b.axis[j][0] + m_[k][1] * b.axis[j][1]) + m_[k][2] * b.axis[j][2];
        center[k] =
            scale_ * ((m_[k][0] * b.center[0] + m_[k][1] * b.center[1]) + m_[k][2] * b.center[2]) +
            t_[k];
    }
    Lanes l;
    std::array<Float4, 3> way;
    for (std::size_t k = 0; k < 3; ++k) way[k] = all_lanes(center[k]) - a.center[k];
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            l.r[i][j] = (a.axis[i][0] * all_lanes(p[0][j]) + a.axis[i][1] * all_lanes(p[1][j])) +
                        a.axis[i][2] * all_lanes(p[2][j]);
        l.t[i] = (a.axis[i][0] * way[0] + a.axis[i][1] * way[1]) + a.axis[i][2] * way[2];
        l.a[i] = a.half[i];
        l.b[i] = all_lanes(scale_ * b.half[i]);
    }
    return l;
}

}  // namespace trisect::detail
