// SPDX-License-Identifier: Apache-2.0
//
// Remarks about what import and rounding changed.
#pragma once

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_model.h>

#include <span>
#include <string>

#include "session.h"

namespace trisect::app {

/// An input and what its import changed.
struct ImportNote {
    std::string name;
    ImportReport report;
    std::string unit = {};    ///< that the file states; empty: none
    ModelReport placed = {};  ///< by transforms in the file
};

/// A unit other than millimetres, and what transforms in the file rounded.
void note_model(Session& session, const std::string& name, const std::string& unit,
                const ModelReport& placed);

/// At most one line about rounding, however many inputs there are, and one for each other change of
/// an input. With --verbose one line about rounding for each input.
void note_imports(Session& session, std::span<const ImportNote> imports);

/// What rounding to a lattice changed, if anything.
void note_rounding(Session& session, const LatticeReport& report, const std::string& name);

}  // namespace trisect::app
