// SPDX-License-Identifier: Apache-2.0
//
// Scene: a boolean job that every engine can be given, found by its name.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace bench {

enum class Operation { Union, Intersection, Difference, ExclusiveOr };

/// "union", "intersection", "difference", "xor".
[[nodiscard]] const char* name_of(Operation operation);
[[nodiscard]] std::optional<Operation> operation_of(const std::string& name);

/// One step of a chain: what so far is there, combined with a tool.
struct Step {
    Operation operation = Operation::Difference;
    trisect::PolygonMesh tool;
    /// Instead of a tool: what lies below all of these planes is kept, the points with
    /// a x + b y + c z + d <= 0.
    std::vector<std::array<double, 4>> planes = {};
};

/// Either one expression or a chain.
///
/// A chain whose every step begins with the operand again is a series of parts: each is evaluated
/// and becomes a mesh, which counts as its evaluation.
///
/// An expression is the union of the first group of operands, combined with the union of the second
/// group; where there is no second one, all operands are combined, in a difference the first one
/// with the union of all others. A chain starts with its only operand and is evaluated after every
/// step; its tools are made when they are due, since there may be a hundred thousand.
struct Scene {
    std::string name;
    std::vector<trisect::PolygonMesh> operands;
    std::size_t first_group = 1;            ///< operands in the first group
    bool is_one_exclusive_or = false;       ///< an exclusive or has no groups
    std::vector<Operation> operations;      ///< that make sense for it
    std::size_t steps = 0;                  ///< of a chain
    std::size_t untimed = 0;                ///< steps at its start that prepare and do not count
    bool indexed = false;                   ///< a chain whose stock is indexed before, untimed
    bool parts = false;                     ///< every step begins with the operand again
    std::function<Step(std::size_t)> step;  ///< by its number, from 0
    [[nodiscard]] bool is_chain() const { return steps != 0; }
    [[nodiscard]] std::size_t first_group_in(Operation operation) const {
        const bool is_one = is_one_exclusive_or && operation == Operation::ExclusiveOr;
        return is_one ? operands.size() : first_group;
    }
};

/// The scenes by name, WHAT:SIZE. All operands of a scene lie on one lattice, unless `decimal:` is
/// before the name: then the scene is a tenth in size and its coordinates have six digits behind
/// the point.
///
///     a:bunny a:armadillo a:cow     100k triangles against themselves, turned by 37 degrees about
///                                   (1,2,3) and moved by a tenth of the box (TRISECT_MODELS)
///     b:5k b:82k b:328k b:1.3M      two icospheres, centres half a radius apart
///     c:82k c:1.3M                  an icosphere less one of 320 triangles and a tenth its size
///     c:82k:near c:1.3M:near        the same after an untimed cut beside it; :far on the other
///                                   side
///     c:82k:indexed c:1.3M:indexed  the same in a part that was indexed before, untimed
///     d:spheres d:cubes             the union of 1000 solids, turned and placed at random
///     d:tori                        the union of fifty tori (TRISECT_MODELS)
///     e:25k e:99k e:400k            milling: 1000 cuts by a sphere of 320 triangles in a block;
///                                   e:99k:10000 for another number of cuts, 1000 a layer
///     f:grid                        1000 cubes united and subtracted one by one, 1999 booleans
///     f:menger3 f:menger4           Menger sponge: a cube less the bars of x, y and z
///     f:beams                       20 beams along x and 20 along y that cross
///     f:fan                         20 cubes turned about an axis, sharing two planes
///     f:gears                       two fans of 50 cubes each, side by side in the same planes
///     f:engrave f:engrave2500       a plate less 10,000 or 2,500 stars, flush with its upper side
///     f:touch f:overlap             10³ cubes that touch in faces, or overlap with coplanar faces
///     i:slabs i:slabs:oblique       51 slabs of the bunny of 100k triangles, each between two
///                                   half-spaces; across z, or across (1,2,3)
///     i:slabs:boxes                 the same slabs across z, by wide boxes
///     i:bores i:bores:10k           a plate less 400 bores of 32 sides, turned each; or 10,000
///     g:x g:y g:z                   as b:82k, but moved along an axis: edges meet edges;
///                                   g:general is b:82k
///     g:mirror g:turn90 g:turn180   an egg of 82k and its image about axes beside its middle
///     g:ballturn90                  a sphere of 82k and itself turned by 90 degrees
///     g:self g:ulp                  a sphere of 82k and itself; with all coordinates one double up
///     g:halves g:stack              two halves of a ball, cans of the same facets one on the other
///     g:tiles                       pieces of terrain side by side
///     g:boss g:slab                 a can under a terrain, on a plate: on the middle of a face
///     h:dense16                     16 nearly equal solids of 800 triangles, turned at random; any
///                                   other number as well, in the next ones, too
///     h:dense16:halves              the union of the first eight with that of the others; any of
///                                   h:
///     h:onion16                     nested ones
///     h:swarm16                     with centres at random in a third of their radius
///     h:cylinders16                 cylinders of 200 sides about one centre, turned at random
///     h:path200                     a plate less capsules that overlap along a path
///     h:copies16                    a bumpy sphere of 800 triangles, moved along x each time
///     h:floor16                     prisms of 200 sides on one floor about one axis
///     h:stack16                     prisms of 200 sides, each on top of the one before
///     h:drills64 h:bores64          a plate less cylinders, flush with its upper side, or with
///                                   both
///     h:slot64                      a plate less flush cylinders that overlap along a line
///     q:record q:record:1000        six statues of 100k triangles with the union of 100,000
///                                   spheres of 234 triangles, or another number (TRISECT_MODELS)
///
/// \throw UsageError for an unknown name, InputError when a model is absent.
[[nodiscard]] Scene make_scene(const std::string& name);

/// What the result must have.
struct Expected {
    double volume = 0;
    double tolerance = 0;  ///< relative, what rounding of coordinates explains
};

/// Nothing for scenes whose volume is not known from elsewhere.
[[nodiscard]] std::optional<Expected> expected(const std::string& scene, Operation operation);

}  // namespace bench
