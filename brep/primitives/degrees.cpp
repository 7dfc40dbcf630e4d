// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/degrees.h>

#include <cmath>
#include <numbers>

namespace trisect::detail {

double sine_of_degrees(double degrees) {
    double a = std::fmod(degrees, 360);
    if (a < 0) a += 360;
    const double sign = a >= 180 ? -1 : 1;
    if (a >= 180) a -= 180;
    if (a > 90) a = 180 - a;
    if (a == 30) return sign * 0.5;
    if (a > 45) return sign * std::cos((90 - a) * std::numbers::pi / 180);
    return sign * std::sin(a * std::numbers::pi / 180) + 0.0;
}

double cosine_of_degrees(double degrees) {
    double a = std::fmod(std::fabs(degrees), 360);
    if (a > 180) a = 360 - a;
    return a > 90 ? -sine_of_degrees(a - 90) + 0.0 : sine_of_degrees(90 - a);
}

}  // namespace trisect::detail
