// SPDX-License-Identifier: Apache-2.0
//
// Sums and products of whole coordinates, and their text.
// The library has none, since coordinates need not be whole; those that tests make are small.
#pragma once

#include <cstdint>
#include <ostream>

#include <trisect/kernel/lattice_point.h>

namespace trisect {

constexpr std::int64_t operator+(Coordinate a, Coordinate b) {
    return a.to_integer() + b.to_integer();
}
constexpr std::int64_t operator-(Coordinate a, Coordinate b) {
    return a.to_integer() - b.to_integer();
}
constexpr std::int64_t operator*(Coordinate a, Coordinate b) {
    return a.to_integer() * b.to_integer();
}
constexpr std::int64_t operator/(Coordinate a, Coordinate b) {
    return a.to_integer() / b.to_integer();
}

inline std::ostream& operator<<(std::ostream& out, Coordinate c) { return out << c.to_integer(); }

constexpr LatticePoint operator+(const LatticePoint& a, const LatticePoint& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr LatticePoint operator-(const LatticePoint& a, const LatticePoint& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

}  // namespace trisect
