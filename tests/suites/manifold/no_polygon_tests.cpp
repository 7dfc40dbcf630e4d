// SPDX-License-Identifier: Apache-2.0
//
// Their main program registers tests of their triangulation, which is not part of the interface.

void RegisterPolygonTests() {}  // NOLINT(readability-identifier-naming)
