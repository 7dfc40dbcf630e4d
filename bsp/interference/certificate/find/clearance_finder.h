// SPDX-License-Identifier: Apache-2.0
//
// ClearanceFinder: search for proofs of disjoint interiors during motions.
// A proof is about one piece of two motions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_clearance.h>
#include <trisect/bsp/interference/certificate/find/proof_body.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/overlap_certificate.h>

namespace trisect::detail {

/// Trees of OverlapCertificate::clearance. What is found need not be right, but every plane has
/// been shown to the checker's Clearance, which judges them.
class ClearanceFinder {
public:
    ClearanceFinder(certified::Clearance& clearance, const ProofBody& b, std::size_t limit);

    /// Nothing where it fails; then failure() says why.
    [[nodiscard]] std::optional<std::vector<ClearanceNode>> find(
        std::shared_ptr<const certified::Part> whole);
    [[nodiscard]] const std::string& failure() const { return failure_; }

private:
    using Approximate = proof::Approximate;
    using Range = certified::ClearanceRange;

    /// An affine map in doubles.
    struct Map {
        std::array<Approximate, 3> m{};
        Approximate t{};
        [[nodiscard]] Approximate point(const Approximate& x) const;
        [[nodiscard]] Approximate direction(const Approximate& v) const;
    };
    /// What both see of each other at a time.
    struct Moment {
        Map to_a;
        Map to_b;
    };
    /// Polynomials of a piece in doubles.
    struct ApproximatePiece {
        std::array<std::array<std::vector<double>, 3>, 3> m;
        std::array<std::vector<double>, 3> t;
        std::vector<double> w;
        explicit ApproximatePiece(const certified::Piece& piece);
        [[nodiscard]] Map at(double s) const;
    };
    /// A node's corners.
    struct Corners {
        std::vector<Approximate> of_a;
        std::vector<std::uint32_t> b;
        std::vector<Approximate> of_b;
        double size_a = 0;
        double size_b = 0;
    };
    struct Candidate {
        SupportingPlane plane;
        Approximate normal{};   // of OfA, OfB
        Approximate along_a{};  // of Edges
        Approximate along_b{};
        Approximate through{};
    };

    [[nodiscard]] bool add(const Range& r, int depth);
    [[nodiscard]] bool split(std::size_t at, const Range& r, const ClearanceNode& node, int depth);
    [[nodiscard]] Moment at(double s) const { return {approximate_a_.at(s), approximate_b_.at(s)}; }
    [[nodiscard]] Corners corners_of(const Range& r) const;
    [[nodiscard]] std::optional<SupportingPlane> plane_with_a_gap(const Range& r, const Corners& c,
                                                                  const std::vector<Moment>& when);
    [[nodiscard]] std::vector<Candidate> candidates(const Range& r, const Corners& c) const;
    void add_sliding(const Range& r, const Corners& c, std::vector<Candidate>& all) const;
    [[nodiscard]] static bool is_plausible(const Candidate& candidate, const Corners& c,
                                           const Moment& when);
    void complete(Candidate& candidate, const Range& r, const Corners& c) const;
    [[nodiscard]] std::optional<ExactRational> time_to_split(
        const Range& r, const Corners& c, const std::vector<Candidate>& all) const;
    [[nodiscard]] std::optional<SeparatingPlane> plane_to_divide(const Range& r,
                                                                 const Corners& c) const;
    [[nodiscard]] static bool moves_far(const Corners& c, const std::vector<Moment>& when);

    certified::Clearance& clearance_;
    const ProofBody& b_;
    ApproximatePiece approximate_a_;
    ApproximatePiece approximate_b_;
    std::size_t limit_;
    std::vector<ClearanceNode> nodes_;
    std::string failure_;
};

/// The fraction with the smallest denominator in a closed interval of positive numbers.
[[nodiscard]] ExactRational simplest_fraction(double low, double high);

}  // namespace trisect::detail
