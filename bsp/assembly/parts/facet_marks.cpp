// SPDX-License-Identifier: Apache-2.0
//
// Numbers of facets that are worked on. A number for each facet would be four times the marks; one
// for every eighth is half of them, and the rest is a count of bits.

#include <trisect/bsp/assembly/parts/facet_marks.h>

namespace trisect::detail {

void FacetMarks::number_worked(std::size_t first, std::size_t end, std::size_t number) {
    auto n = static_cast<std::int32_t>(number);
    for (std::size_t i = first; i < end; ++i) {
        numbers_[i] = n;
        n += count(worked_in(eight_at(8 * i)));
    }
}

}  // namespace trisect::detail
