// SPDX-License-Identifier: Apache-2.0

#include "chain_rebuild.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/pose.h>

#if defined(TRISECT_WITH_CGAL)
#include "query_peers.h"
#endif
#if defined(TRISECT_WITH_FCL)
#include "interference_peers.h"
#endif

namespace {

using trisect::PolygonMesh;
using trisect::Solid;

Solid imported(const PolygonMesh& mesh) {
    trisect::SolidOptions options;
    options.embedding = trisect::Embedding::Assume;
    return Solid::from_mesh(mesh, options);
}

}  // namespace

ChainRebuild::ChainRebuild(PolygonMesh holder, bool models)
    : holder_(std::move(holder)), models_(models) {}

void ChainRebuild::ask(const Solid& version, const ChainQuestions& q) {
    PolygonMesh mesh;
    mesh_.add_milliseconds(milliseconds_of([&] { mesh = version.to_mesh(1); }));
    ask_ourselves(mesh, q);
    ask_cgal(mesh, q);
    ask_fcl(mesh, q);
}

void ChainRebuild::ask_ourselves(const PolygonMesh& mesh, const ChainQuestions& q) {
    Solid solid;
    import_.add_milliseconds(milliseconds_of([&] {
        solid = imported(mesh);
        solid.refine();
    }));
    index_.add_milliseconds(
        milliseconds_of([&] { (void)trisect::BrepIndex(solid).locate(q.near).location; }));
    if (!models_) return;
    std::optional<trisect::InterferenceModel> model;
    model_.add_milliseconds(milliseconds_of([&] { model.emplace(solid); }));
    const trisect::InterferenceModel holder(imported(holder_));
    interfere_.add_milliseconds(milliseconds_of([&] {
        (void)interfere(*model, trisect::Pose(), holder, trisect::Pose::from_translation(q.holder));
    }));
}

void ChainRebuild::ask_cgal([[maybe_unused]] const PolygonMesh& mesh,
                            [[maybe_unused]] const ChainQuestions& q) {
#if defined(TRISECT_WITH_CGAL)
    const auto peer = query_peers::make_cgal(mesh);
    cgal_tree_.add_milliseconds(1000 * peer->build_seconds());
    cgal_first_.add_milliseconds(milliseconds_of([&] {
        std::array<query_peers::Side, 1> side{};
        peer->locate(std::span(&q.near, 1), side);
        std::array<std::int64_t, 1> hit{};
        const trisect::Point3d inwards{q.middle[0] - q.far[0], q.middle[1] - q.far[1],
                                       q.middle[2] - q.far[2]};
        const query_peers::Ray ray{q.far, inwards};
        peer->first_hits(std::span(&ray, 1), hit);
        std::array<double, 1> distance{};
        peer->squared_distances(std::span(&q.above, 1), distance);
    }));
#endif
}

void ChainRebuild::ask_fcl([[maybe_unused]] const PolygonMesh& mesh,
                           [[maybe_unused]] const ChainQuestions& q) {
#if defined(TRISECT_WITH_FCL)
    interference_peers::Placement at = interference_peers::home_placement;
    for (std::size_t k = 0; k < 3; ++k) at[4 * k + 3] = q.holder[k];
    interference_peers::Peers peers;
    interference_peers::add_fcl_obbrss(peers, mesh, holder_, std::span(&at, 1));
    fcl_model_.add_milliseconds(1000 * peers[0]->build_seconds());
    fcl_collide_.add_milliseconds(milliseconds_of([&] { (void)peers[0]->collide(0); }));
    fcl_distance_.add_milliseconds(milliseconds_of([&] { (void)peers[0]->distance(0); }));
#endif
}

void ChainRebuild::print() const {
    for (const Series* s : {&mesh_, &import_, &index_, &model_, &interfere_, &cgal_tree_,
                            &cgal_first_, &fcl_model_, &fcl_collide_, &fcl_distance_})
        s->print();
}
