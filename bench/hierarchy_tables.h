// SPDX-License-Identifier: Apache-2.0
//
// Tables of compare_hierarchies that have scenes of their own.
#pragma once

/// Trees of boxes after a thousand and ten thousand changes, against trees built anew.
void print_changes();

/// Trees of volumes of all kinds refitted to a solid that changes its shape, against new ones.
void print_deformation();

/// Sphere trees: the volume of each level, how far it stands out, and answers after some tests.
void print_spheres();
