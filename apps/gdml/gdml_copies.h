// SPDX-License-Identifier: Apache-2.0
//
// Moves of the copies that replicas and divisions place.
//
// Along x, y and z, as Geant4 places them: a replica of n copies is centred in its mother, a
// division begins at the lower side of its mother and an offset. Its mother is a box, and its
// daughter a box that is as wide as a copy there.
#pragma once

#include <trisect/kernel/point3d.h>

#include <vector>

#include "gdml_solids.h"

namespace trisect::app {

/// Of an element <replicavol>, in steps. \throw InputError, LimitError, UnsupportedError for other
/// axes
[[nodiscard]] std::vector<Point3d> gdml_replica_moves(const GdmlSource& source,
                                                      const GdmlElement& element);

/// Of an element <divisionvol>, given the elements of the solids of the mother and the daughter.
/// \throw InputError, LimitError, UnsupportedError for other axes and for solids that are no such
/// boxes
[[nodiscard]] std::vector<Point3d> gdml_division_moves(const GdmlSource& source,
                                                       const GdmlElement& element,
                                                       const GdmlElement& mother,
                                                       const GdmlElement& daughter);

}  // namespace trisect::app
