// SPDX-License-Identifier: Apache-2.0
//
// Volumes that results must have. Those with round numbers follow from the construction; the others
// are what at least two independent exact libraries agree on to twelve digits (CGAL corefinement
// with exact points, CGAL Nef polyhedra, geogram).

#include <array>
#include <string_view>

#include "scene.h"

namespace bench {

namespace {

struct Row {
    std::string_view scene;
    Operation operation;
    double volume;
};

constexpr Operation U = Operation::Union;
constexpr Operation I = Operation::Intersection;
constexpr Operation D = Operation::Difference;

constexpr std::array rows{
    Row{"a:bunny", U, .0744469964484},
    Row{"a:bunny", I, .0224669821166},
    Row{"a:bunny", D, .0259900071659},
    Row{"a:armadillo", U, .114765236367},
    Row{"a:armadillo", I, .0223049833801},
    Row{"a:armadillo", D, .0462301264935},
    Row{"b:5k", U, 5.71552423197},
    Row{"b:5k", I, 2.64395366402},
    Row{"b:5k", D, 1.53578528397},
    Row{"b:82k", U, 5.72615218074},
    Row{"b:82k", I, 2.65029529562},
    Row{"b:82k", D, 1.53792844256},
    Row{"b:328k", U, 5.72668424364},
    Row{"b:328k", I, 2.65061291353},
    Row{"b:328k", D, 1.53803566506},
    Row{"b:1.3M", U, 5.72681726595},
    Row{"b:1.3M", I, 2.65069232933},
    Row{"b:1.3M", D, 1.53806246831},
    Row{"c:1.3M", D, 4.18680643846},
    Row{"d:spheres", U, .934741171922},
    Row{"d:cubes", U, .663963441738},
    Row{"e:99k:500", D, .992829098733},
    Row{"f:grid", D, 0},
    Row{"f:engrave", D, 8392.774700775515},
    Row{"f:menger3", D, 8'000},
    Row{"f:menger4", D, 160'000},
    Row{"f:beams", U, 1'440},
    Row{"f:beams", I, 200},
    Row{"f:beams", D, 620},
    Row{"f:touch", U, 1'000},
    Row{"f:overlap", U, 465.484375},
};

}  // namespace

std::optional<Expected> expected(const std::string& scene, Operation operation) {
    for (const Row& r : rows)
        if (r.scene == scene && r.operation == operation) return Expected{r.volume, 1e-10};
    return std::nullopt;
}

}  // namespace bench
