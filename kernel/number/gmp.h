// SPDX-License-Identifier: Apache-2.0
//
// Integers and fractions of any length.
// The only header that includes GMP, so that another library could take its place here. Never
// included by a public header: programs that use the library need GMP's library, but not its
// headers.
#pragma once

#include <gmpxx.h>
