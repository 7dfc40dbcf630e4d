// SPDX-License-Identifier: Apache-2.0
//
// Contents of the opaque handles of the C interface.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include <trisect-c/trisect.h>

#include <trisect/brep/brep.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/edited_formula.h>
#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

struct trisect_cancel {
    std::atomic<bool> flag{false};
};
struct trisect_text {
    std::string text;
};
struct trisect_solid {
    trisect::Solid solid;
};
struct trisect_edited {
    trisect::EditedFormula formula;
};
struct trisect_solid_list {
    std::vector<trisect::Solid> solids;
};
struct trisect_mesh {
    trisect::PolygonMesh mesh;
    std::vector<trisect::FaceSource> sources;
};
struct trisect_section {
    struct Loop {
        std::size_t region = 0;
        bool is_hole = false;
        std::vector<trisect::Point3d> points;
    };
    std::vector<Loop> loops;
};
struct trisect_pose {
    trisect::Pose pose;
};
struct trisect_motion {
    trisect::Motion motion;
};
struct trisect_scene {
    trisect::Scene scene;
    std::vector<trisect_pair> pairs;
};
struct trisect_report {
    trisect::ValidationReport report;
};
