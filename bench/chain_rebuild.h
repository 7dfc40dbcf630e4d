// SPDX-License-Identifier: Apache-2.0
//
// What the same questions take where everything is made anew for each version.
#pragma once

#include <vector>

#include <trisect/bsp/solid.h>
#include <trisect/kernel/point3d.h>

#include "chain_series.h"

/// Questions beside a cut.
struct ChainQuestions {
    trisect::Point3d near{};    ///< a point in the stock, to be located
    trisect::Point3d far{};     ///< whence a ray goes to the middle
    trisect::Point3d middle{};  ///< of the stock, below the cut
    trisect::Point3d above{};   ///< a point off the stock, to whose nearest point is asked
    trisect::Point3d holder{};  ///< where the holder's middle is, above the cut
    trisect::Point3d aside{};   ///< the same beside the cut, off what is left of the surface
};

/// Rows of what is rebuilt: this library's index and model, and where they are there the
/// hierarchies of CGAL and FCL.
class ChainRebuild {
public:
    /// `models`: interference, too, which takes seconds for a million triangles.
    ChainRebuild(trisect::PolygonMesh holder, bool models);
    void ask(const trisect::Solid& version, const ChainQuestions& q);
    void print() const;

private:
    void ask_ourselves(const trisect::PolygonMesh& mesh, const ChainQuestions& q);
    void ask_cgal(const trisect::PolygonMesh& mesh, const ChainQuestions& q);
    void ask_fcl(const trisect::PolygonMesh& mesh, const ChainQuestions& q);

    trisect::PolygonMesh holder_;
    bool models_;
    Series mesh_{"the version's mesh"};
    Series import_{"rebuilt: import and refine"};
    Series index_{"rebuilt: BrepIndex and first point"};
    Series model_{"rebuilt: InterferenceModel"};
    Series interfere_{"rebuilt: first interfere"};
    Series cgal_tree_{"CGAL: AABB_tree"};
    Series cgal_first_{"CGAL: first point, ray, distance"};
    Series fcl_model_{"FCL: BVHModel of OBBRSS"};
    Series fcl_collide_{"FCL: first collide"};
    Series fcl_distance_{"FCL: first distance"};
};
