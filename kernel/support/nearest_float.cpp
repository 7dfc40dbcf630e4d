// SPDX-License-Identifier: Apache-2.0
#include <trisect/kernel/support/nearest_float.h>

namespace trisect::detail {

double nearest_float(double v) { return static_cast<double>(static_cast<float>(v)); }

}  // namespace trisect::detail
