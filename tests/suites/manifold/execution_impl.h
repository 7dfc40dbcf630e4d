// SPDX-License-Identifier: Apache-2.0
//
// Stand-in for a private header of Manifold's that its tests include: what they use of it.
#pragma once

#include <set>
#include <sstream>

#include <settings.h>
