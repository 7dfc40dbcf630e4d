// SPDX-License-Identifier: Apache-2.0
//
// Lossless text format of boundaries.
// A boundary is read back bit for bit on every machine. Files of version 1 have integers only.
// Boundaries with coordinates that have bits behind the point are of version 2: there a coordinate
// may be a decimal number, the shortest one that is nearest to its double, and planes have up to
// 328 and 383 bits instead of 109 and 162. The exponent of the lattice is from -1200 to 1016, and
// in version 1 a multiple of 8.
//
//     trisect-exact 1
//     lattice -32                      unit: coordinates are multiples of 2^-32
//     planes 9
//     1 0 0 -4                         a b c d: a x + b y + c z + d = 0, integers
//     ...
//     vertices 14
//     p 0 0 4                          a lattice point
//     q 0 3 7                          the common point of planes number 0, 3 and 7
//     ...
//     faces 8
//     0 5 12 1 4 0 1 2 3               plane, operand and face of the source, number of loops,
//     ...                              then each loop: number of corners, corners
//
// Everything counts from 0, in units of the lattice. Planes look outward; the first loop of a face
// is its outer one, counter-clockwise seen from outside, the others are holes, clockwise (of two
// corners: a slit). Points
// where the solid touches itself are listed once. `#` begins a comment. Any program with integers
// of 512 bits (in version 2: of any length) can check a file: every corner is on its face's plane,
// every edge is used equally often both ways.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <trisect/brep/brep.h>
#include <trisect/brep/io/read_mesh.h>

namespace trisect {

[[nodiscard]] std::string exact_text(const Brep& brep);

/// \throw InputError with line and column for what does not follow the format, for planes and
/// points beyond the bounds of Plane and LatticePoint, planes that do not meet in one point, two
/// vertices at one place, corners off their plane and loops that run the wrong way; Error
/// (InvalidSolid) for edges that do not cancel; LimitError.
[[nodiscard]] Brep read_exact(std::string_view text, const std::string& name,
                              const ReadLimits& limits = {});
[[nodiscard]] Brep read_exact(const std::filesystem::path& path, const ReadLimits& limits = {});

}  // namespace trisect
