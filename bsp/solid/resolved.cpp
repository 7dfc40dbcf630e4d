// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/solid/resolved.h>

#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

Solid resolved(const Solid& solid, const EvaluateOptions& options) {
    return state_of(solid)->embedded ? solid : evaluate(Expression(solid), options);
}

}  // namespace trisect::detail
