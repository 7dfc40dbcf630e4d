// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/trimmed.h>

namespace trisect {

Solid trimmed(const Solid& solid, const std::array<double, 4>& plane,
              const EvaluateOptions& options) {
    return evaluate(solid - Solid::half_space(plane), options);
}

}  // namespace trisect
