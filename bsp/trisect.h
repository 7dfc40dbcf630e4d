// SPDX-License-Identifier: Apache-2.0
//
// Umbrella header for reading meshes, combining solids and writing results.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/certificate.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/bsp_tree.h>
#include <trisect/bsp/cell_tree_view.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/contact_certificate.h>
#include <trisect/bsp/interference/distance_certificate.h>
#include <trisect/bsp/interference/enclosed_certificate.h>
#include <trisect/bsp/interference/enclosed_contact.h>
#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/interference_overlap.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/interference/joint.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/moving_points.h>
#include <trisect/bsp/interference/overlap_certificate.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/verify.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/stop_scope.h>
