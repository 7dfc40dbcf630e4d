// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/special_position.h>

#include <algorithm>

namespace trisect::detail {

void SpecialPosition::want(const OperandShifts::Wanted& wanted) {
    const auto at = std::ranges::lower_bound(wanted_, wanted);
    if (at == wanted_.end() || *at != wanted) wanted_.insert(at, wanted);
}

}  // namespace trisect::detail
