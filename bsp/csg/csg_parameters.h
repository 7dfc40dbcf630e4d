// SPDX-License-Identifier: Apache-2.0
//
// Names of arguments that stand without one, by OpenSCAD's parameter lists.
// OpenSCAD writes nearly all arguments with names; programs written by hand do not.
#pragma once

#include <trisect/bsp/csg/csg_tree.h>

namespace trisect::detail {

/// Gives every argument of a known node its name. Names that begin with $ are free.
/// \throw CsgError (Input) where there are more arguments than parameters; (Unsupported) where one
/// has a name that is no parameter of the node: left out it may change the solid.
void name_csg_arguments(CsgTree& tree);

}  // namespace trisect::detail
