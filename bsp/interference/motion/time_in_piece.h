// SPDX-License-Identifier: Apache-2.0
//
// TimeInPiece: a time of contact in the form used by certificates.
#pragma once

#include <cstddef>
#include <vector>

#include <trisect/brep/algebraic_number.h>

namespace trisect::detail {

/// The piece of the motions in which a time is, or at whose end, and the only root of a polynomial
/// (constant coefficient first) in an open interval of the piece's parameter.
struct TimeInPiece {
    std::size_t piece = 0;
    std::vector<ExactRational> polynomial;
    double lower = 0;
    double upper = 0;
    bool is_start = false;  ///< the very start of the first piece
    bool is_end = false;    ///< the very end of the piece
};

[[nodiscard]] TimeInPiece time_in_piece(const AlgebraicNumber& time);

}  // namespace trisect::detail
