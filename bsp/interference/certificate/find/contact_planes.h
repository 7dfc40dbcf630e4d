// SPDX-License-Identifier: Apache-2.0
//
// ContactPlanes: planes of a first-contact certificate at the contact itself.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/brep/number/real_root.h>
#include <trisect/bsp/interference/certificate/find/gmp_vector.h>
#include <trisect/bsp/interference/certificate/find/moving_heights.h>
#include <trisect/bsp/interference/certificate/find/proof_body.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/contact_certificate.h>
#include <trisect/bsp/interference/motion/motion_piece.h>

namespace trisect::detail {

/// A time of contact, exactly and between doubles.
struct BracketedTime {
    RealRoot time;
    double lower = 0;
    double upper = 0;
};

/// Planes that keep two triangles apart up to a contact, and where triangles meet at it. Keeps
/// references to the bodies and to the maps: how A sees B, and the other way round.
class ContactPlanes {
public:
    ContactPlanes(const ProofBody& a, const MotionPiece& to_a, const ProofBody& b,
                  const MotionPiece& to_b, BracketedTime contact)
        : a_(a), b_(b), to_a_(to_a), to_b_(to_b), contact_(std::move(contact)) {}

    /// Of the triangles i of A and j of B, from a time on; nothing where no candidate works.
    [[nodiscard]] std::optional<MovingSeparator> plane(std::size_t i, std::size_t j, double from);
    /// Of the same, at the contact.
    [[nodiscard]] std::optional<CommonPoint> common_point(std::size_t i, std::size_t j);

private:
    using Corners = std::array<GmpVector, 3>;

    [[nodiscard]] bool is_positive(const IntegerPolynomial& p, double from);
    [[nodiscard]] std::optional<MovingSeparator> plane_of_one(MovingSeparator::Kind kind,
                                                              const Corners& p, const Corners& q,
                                                              double from);
    [[nodiscard]] static std::vector<GmpVector> candidates(const Corners& resting,
                                                           const std::vector<MovingPoint>& paths,
                                                           double from);
    [[nodiscard]] std::optional<MovingSeparator> plane_along_edges(std::size_t i, std::size_t j,
                                                                   const Corners& p,
                                                                   const Corners& q, double from);
    [[nodiscard]] int sign_of(const IntegerPolynomial& p) {
        return p.is_zero() ? 0 : contact_.time.sign_of(p);
    }
    [[nodiscard]] bool is_on(const MovingPoint& x, const Corners& t);
    [[nodiscard]] bool cross_each_other(const GmpVector& a0, const GmpVector& a1,
                                        const GmpVector& b0, const GmpVector& b1);

    const ProofBody& a_;
    const ProofBody& b_;
    const MotionPiece& to_a_;
    const MotionPiece& to_b_;
    BracketedTime contact_;
};

}  // namespace trisect::detail
