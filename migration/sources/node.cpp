// SPDX-License-Identifier: Apache-2.0

#include "node.h"

#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/triangle_view.h>
#include <trisect/kernel/error.h>

namespace manifold {

namespace {

using trisect::Solid;

trisect::PolygonMesh polygons_of(const TriMesh& mesh) {
    trisect::PolygonMesh polygons;
    for (const vec3& p : mesh.points) polygons.points.push_back({p.x, p.y, p.z});
    for (const Triple& t : mesh.corners) polygons.add_triangle(t[0], t[1], t[2]);
    return polygons;
}

// Faces are named by their groups, so that the assembly joins what is left of one.
Solid import_named(const TriMesh& mesh, const std::vector<std::uint32_t>& group) {
    if (mesh.corners.empty()) return {};
    trisect::ImportedMesh imported = trisect::import_mesh(polygons_of(mesh));
    if (imported.mesh.triangles.empty()) return {};
    // Inside is where the winding number is positive.
    if (imported.report.inside_out) return {};
    std::vector<std::uint32_t> face;
    face.reserve(imported.mesh.triangles.size());
    for (std::uint32_t t = 0; t < imported.mesh.triangles.size(); ++t)
        face.push_back(group[imported.mesh.face_of(t)]);
    imported.mesh.face_of_triangle = std::move(face);
    return Solid::from_import(std::move(imported), trisect::Embedding::Check);
}

NamedSolid named(Solid solid, std::shared_ptr<const FaceTable> table) {
    NamedSolid s;
    s.runs = table->mesh.runs;
    s.width = table->mesh.width;
    if (!solid.is_empty()) s.pieces[solid.source_id()] = {.table = std::move(table)};
    s.solid = std::move(solid);
    return s;
}

}  // namespace

ManifoldNode::Ptr ManifoldNode::of_error(Error error) {
    auto node = std::make_shared<ManifoldNode>();
    node->status_ = error;
    node->lazy_ = std::make_shared<Lazy>();
    node->lazy_->mesh.emplace();
    return node;
}

ManifoldNode::Ptr ManifoldNode::of_mesh(TriMesh mesh, int original, double tolerance) {
    auto node = std::make_shared<ManifoldNode>();
    node->original_ = original;
    node->tolerance_ = tolerance;
    node->lazy_ = std::make_shared<Lazy>();
    node->lazy_->mesh = std::move(mesh);
    return node;
}

ManifoldNode::Ptr ManifoldNode::of_solid(NamedSolid solid, double tolerance) {
    auto node = std::make_shared<ManifoldNode>();
    node->tolerance_ = tolerance;
    node->mesh_first_ = false;
    node->lazy_ = std::make_shared<Lazy>();
    node->lazy_->solid = std::move(solid);
    return node;
}

ManifoldNode::Ptr ManifoldNode::of_both(TriMesh mesh, Solid solid, std::vector<std::uint32_t> group,
                                        int original, double tolerance) {
    auto node = std::make_shared<ManifoldNode>();
    node->original_ = original;
    node->tolerance_ = tolerance;
    node->mesh_first_ = false;
    node->lazy_ = std::make_shared<Lazy>();
    node->lazy_->mesh = mesh;
    node->lazy_->solid = named(std::move(solid), face_table(std::move(mesh), group));
    return node;
}

ManifoldNode::Ptr ManifoldNode::with_tolerance(double tolerance) const {
    auto node = std::make_shared<ManifoldNode>(*this);
    node->tolerance_ = tolerance;
    return node;
}

ManifoldNode::Ptr ManifoldNode::with_context(
    std::shared_ptr<ExecutionContext::Impl> context) const {
    auto node = std::make_shared<ManifoldNode>(*this);
    node->context_ = std::move(context);
    return node;
}

bool ManifoldNode::is_empty() const {
    return mesh_first_ ? lazy_->mesh->corners.empty() : lazy_->solid->solid.is_empty();
}

const TriMesh& ManifoldNode::mesh() const {
    std::call_once(lazy_->mesh_made, [&] {
        if (!lazy_->mesh) lazy_->mesh = triangles_of(*lazy_->solid);
    });
    return *lazy_->mesh;
}

const NamedSolid& ManifoldNode::solid() const {
    std::call_once(lazy_->solid_made, [&] {
        if (lazy_->solid) return;
        const std::vector<std::uint32_t> group = groups_of(*lazy_->mesh);
        lazy_->solid = named(import_named(*lazy_->mesh, group), face_table(*lazy_->mesh, group));
    });
    return *lazy_->solid;
}

}  // namespace manifold
