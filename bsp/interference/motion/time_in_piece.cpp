// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/motion/time_in_piece.h>

#include <cmath>
#include <cstdint>

namespace trisect::detail {

namespace {

// p(s + n), constant coefficient first.
std::vector<ExactRational> shifted(std::vector<ExactRational> p, std::size_t n) {
    const ExactRational by(static_cast<std::int64_t>(n));
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        for (std::size_t j = p.size() - 1; j-- > i;) p[j] += by * p[j + 1];
    return p;
}

}  // namespace

TimeInPiece time_in_piece(const AlgebraicNumber& time) {
    const AlgebraicNumber narrow = time.refined(ExactRational(1).scaled(-80));
    const auto whole = [](std::size_t n) {
        return AlgebraicNumber(ExactRational(static_cast<std::int64_t>(n)));
    };
    TimeInPiece r;
    while (whole(r.piece + 1) < time) ++r.piece;
    r.is_start = time == whole(0);
    r.is_end = time == whole(r.piece + 1);
    const ExactRational start(static_cast<std::int64_t>(r.piece));
    r.polynomial = narrow.is_rational()
                       ? std::vector<ExactRational>{start - narrow.lower(), ExactRational(1)}
                       : shifted(narrow.polynomial(), r.piece);
    r.lower = std::nextafter((narrow.lower() - start).to_double(), -1.0);
    r.upper = std::nextafter((narrow.upper() - start).to_double(), 2.0);
    return r;
}

}  // namespace trisect::detail
