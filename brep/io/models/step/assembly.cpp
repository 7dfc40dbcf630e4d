// SPDX-License-Identifier: Apache-2.0
//
// Axes of a placement have any length and need not be perpendicular: the first one stays, the
// second loses its part along it, both are normalized in doubles. Axes along the coordinate axes
// are exact by that, and so are the quarter turns between them; translations are always.
#include <trisect/brep/io/models/step/assembly.h>

#include <trisect/brep/io/models/step/shapes.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>

namespace trisect::detail {
namespace {

/// Solids that are no B-reps of faces. Left out of a result they would change it.
constexpr std::array<std::string_view, 22> other_solids{"BLOCK",
                                                        "BOOLEAN_RESULT",
                                                        "BOXED_HALF_SPACE",
                                                        "CSG_SOLID",
                                                        "CYCLIDE_SEGMENT_SOLID",
                                                        "ECCENTRIC_CONE",
                                                        "ELLIPSOID",
                                                        "EXTRUDED_AREA_SOLID",
                                                        "EXTRUDED_FACE_SOLID",
                                                        "FACETED_PRIMITIVE",
                                                        "HALF_SPACE_SOLID",
                                                        "RECTANGULAR_PYRAMID",
                                                        "REVOLVED_AREA_SOLID",
                                                        "REVOLVED_FACE_SOLID",
                                                        "RIGHT_ANGULAR_WEDGE",
                                                        "RIGHT_CIRCULAR_CONE",
                                                        "RIGHT_CIRCULAR_CYLINDER",
                                                        "SOLID_REPLICA",
                                                        "SPHERE",
                                                        "SWEPT_DISK_SOLID",
                                                        "TORUS",
                                                        "TRIMMED_VOLUME"};

bool has_ending(std::string_view word, std::string_view end) { return word.ends_with(end); }

/// REPRESENTATION(name, items, context), whatever kind of representation of a shape it is.
const StepPart* representation_part(const StepEntity& entity) {
    if (entity.parts.size() > 1) {
        const bool is_shape =
            std::any_of(entity.parts.begin(), entity.parts.end(), [](const StepPart& p) {
                return has_ending(p.keyword, "SHAPE_REPRESENTATION") &&
                       p.keyword != "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION";
            });
        return is_shape ? entity.part("REPRESENTATION") : nullptr;
    }
    const std::string_view keyword = entity.parts.front().keyword;
    const bool is_shape =
        keyword == "REPRESENTATION" || (has_ending(keyword, "SHAPE_REPRESENTATION") &&
                                        keyword != "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION");
    return is_shape ? &entity.parts.front() : nullptr;
}

/// RELATIONSHIP(name, description, first, second)
const StepPart* relationship_part(const StepEntity& entity) {
    for (const char* keyword :
         {"REPRESENTATION_RELATIONSHIP", "SHAPE_REPRESENTATION_RELATIONSHIP"}) {
        const StepPart* part = entity.part(keyword);
        if (part != nullptr && part->values.size() >= 4) return part;
    }
    return nullptr;
}

class AssemblyReader {
public:
    explicit AssemblyReader(const StepText& text) : text_(text), shapes_(text, unread_) {}

    std::vector<StepFrame> read() {
        collect();
        tie();
        read_products();
        for (const auto& [id, rep] : representations_) add_items(rep);
        for (const Relation& r : relations_)
            if (r.transformation != 0) add_placed(r);
        for (StepFrame& f : frames_) {
            std::sort(f.shapes.begin(), f.shapes.end());
            f.shapes.erase(std::unique(f.shapes.begin(), f.shapes.end()), f.shapes.end());
            leave_out_repeated(f);
        }
        return std::move(frames_);
    }

private:
    struct Representation {
        StepEntity entity;
        std::size_t number = 0;
    };
    struct Relation {
        StepEntity entity;
        std::uint64_t first = 0;
        std::uint64_t second = 0;
        std::uint64_t transformation = 0;
    };

    /// All entities that say where shapes are.
    void collect() {
        for (std::size_t i = 0; i < text_.entity_count(); ++i) {
            check_stop();
            const std::string_view keyword = text_.keyword(i);
            const bool may_matter = keyword.empty() || has_ending(keyword, "REPRESENTATION") ||
                                    has_ending(keyword, "REPRESENTATION_RELATIONSHIP");
            if (!may_matter) continue;
            const StepEntity entity = text_.entity(text_.id(i), text_.source().begin());
            if (entity.is("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"))
                dependents_.push_back(entity);
            else if (entity.is("SHAPE_DEFINITION_REPRESENTATION"))
                definitions_.push_back(entity);
            else if (representation_part(entity) != nullptr)
                representations_.emplace(entity.id,
                                         Representation{entity, representations_.size()});
            else if (relationship_part(entity) != nullptr)
                add_relation(entity);
        }
    }

    void add_relation(const StepEntity& entity) {
        const StepPart& part = *relationship_part(entity);
        Relation made{entity, text_.value(entity, part, 2, StepKind::Reference).id,
                      text_.value(entity, part, 3, StepKind::Reference).id, 0};
        const StepPart* moved = entity.part("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION");
        if (moved != nullptr) {
            const std::size_t index = entity.parts.size() > 1 ? 0 : 4;
            made.transformation = text_.value(entity, *moved, index, StepKind::Reference).id;
        }
        relations_.push_back(std::move(made));
    }

    std::size_t root(std::size_t a) {
        while (parents_[a] != a) a = parents_[a] = parents_[parents_[a]];
        return a;
    }

    /// Frames of representations that are tied together.
    void tie() {
        for (std::size_t i = 0; i < representations_.size(); ++i) parents_.push_back(i);
        for (const Relation& r : relations_) {
            const auto first = representations_.find(r.first);
            const auto second = representations_.find(r.second);
            if (r.transformation != 0 || first == representations_.end() ||
                second == representations_.end())
                continue;
            parents_[root(first->second.number)] = root(second->second.number);
        }
        std::map<std::size_t, std::size_t> numbers;
        for (const auto& [id, rep] : representations_)
            frame_of_.emplace(id,
                              numbers.try_emplace(root(rep.number), numbers.size()).first->second);
        frames_.resize(numbers.size());
    }

    void add_items(const Representation& rep) {
        StepFrame& frame = frames_[frame_of_.at(rep.entity.id)];
        const StepPart& part = *representation_part(rep.entity);
        const std::size_t before = frame.shapes.size() + frame.children.size();
        for (const StepValue& v : text_.value(rep.entity, part, 1, StepKind::List).items) {
            check_stop();
            if (v.kind != StepKind::Reference)
                text_.fail(rep.entity, "a list of references expected");
            const std::string_view keyword = text_.keyword(text_.place_of(v.id, v.at));
            if (StepShapes::is_shape(keyword)) {
                frame.shapes.push_back(v.id);
            } else if (keyword == "MAPPED_ITEM") {
                add_mapped(frame, text_.entity(v.id, v.at));
            } else if (keyword.empty()) {
                const StepEntity item = text_.entity(v.id, v.at);
                for (const StepPart& p : item.parts) {
                    if (StepShapes::is_shape(p.keyword)) {
                        frame.shapes.push_back(v.id);
                        break;
                    }
                }
            } else if (std::find(other_solids.begin(), other_solids.end(), keyword) !=
                       other_solids.end()) {
                text_.refuse(text_.entity(v.id, v.at), "solids are read where they are B-reps");
            }
        }
        if (frame.shapes.size() + frame.children.size() == before || part.values.size() < 3) return;
        if (part.values[2].kind == StepKind::Reference) frame.contexts.push_back(part.values[2].id);
    }

    /// Surface models of shells that B-reps in the same place have: some programs write both, for
    /// readers that know only one.
    void leave_out_repeated(StepFrame& frame) const {
        std::set<std::uint64_t> of_solids;
        std::map<std::uint64_t, std::vector<std::uint64_t>> of_models;
        for (const std::uint64_t id : frame.shapes) {
            check_stop();
            StepShapes::Shells shells = shapes_.shells(text_.entity(id, text_.source().begin()));
            if (shells.is_solid)
                of_solids.insert(shells.ids.begin(), shells.ids.end());
            else
                of_models.emplace(id, std::move(shells.ids));
        }
        std::erase_if(frame.shapes, [&](std::uint64_t id) {
            const auto at = of_models.find(id);
            return at != of_models.end() && !at->second.empty() &&
                   std::all_of(at->second.begin(), at->second.end(),
                               [&](std::uint64_t shell) { return of_solids.contains(shell); });
        });
    }

    /// MAPPED_ITEM(name, REPRESENTATION_MAP(origin, representation), target)
    void add_mapped(StepFrame& frame, const StepEntity& item) {
        const StepPart& part = item.parts.front();
        const StepEntity source = text_.referred(item, part, 1);
        const StepPart* map = source.part("REPRESENTATION_MAP");
        if (map == nullptr) text_.refuse(source, "is not read as the source of a mapped item");
        const auto found = frame_of_.find(text_.value(source, *map, 1, StepKind::Reference).id);
        if (found == frame_of_.end()) return;  // not of a shape
        frames_[found->second].is_placed = true;
        frame.children.push_back(
            {found->second, between(text_.referred(source, *map, 0), text_.referred(item, part, 2)),
             item.at});
    }

    /// The first representation in the second one; the other way where the product says that the
    /// second one is the part.
    void add_placed(const Relation& r) {
        auto part = frame_of_.find(r.first);
        auto whole = frame_of_.find(r.second);
        if (part == frame_of_.end() || whole == frame_of_.end()) return;
        const StepEntity moved = text_.entity(r.transformation, r.entity.at);
        const StepPart* items = moved.part("ITEM_DEFINED_TRANSFORMATION");
        if (items == nullptr) text_.refuse(moved, "is not read as a transformation");
        StepEntity from = text_.referred(moved, *items, 2);
        StepEntity to = text_.referred(moved, *items, 3);
        if (is_turned(r)) {
            std::swap(part, whole);
            std::swap(from, to);
        }
        frames_[part->second].is_placed = true;
        frames_[whole->second].children.push_back({part->second, between(from, to), r.entity.at});
    }

    /// Which product definition each relationship with a transformation is in, and the frames and
    /// names of product definitions.
    void read_products() {
        for (const StepEntity& d : dependents_) {
            const StepPart& part = d.parts.front();
            const StepEntity shape = text_.referred(d, part, 1);
            const StepEntity occurrence = text_.referred(shape, shape.parts.front(), 2);
            const StepPart* usage = occurrence.part("NEXT_ASSEMBLY_USAGE_OCCURRENCE");
            if (usage == nullptr || usage->values.size() < 5) continue;
            whole_of_.emplace(text_.value(d, part, 0, StepKind::Reference).id,
                              text_.value(occurrence, *usage, 3, StepKind::Reference).id);
        }
        for (const StepEntity& d : definitions_) {
            const StepPart& part = d.parts.front();
            const auto found = frame_of_.find(text_.value(d, part, 1, StepKind::Reference).id);
            if (found == frame_of_.end()) continue;
            StepEntity at = text_.referred(d, part, 0);
            const StepPart& shape = at.parts.front();
            if (shape.values.size() > 2 && shape.values[2].kind == StepKind::Reference)
                shown_.emplace(shape.values[2].id, found->second);
            name_frame(frames_[found->second], std::move(at));
        }
    }

    /// PRODUCT_DEFINITION_SHAPE, PRODUCT_DEFINITION, its formation, PRODUCT
    void name_frame(StepFrame& frame, StepEntity at) const {
        if (!frame.name.empty()) return;
        for (int step = 0; step < 3 && !at.is("PRODUCT"); ++step) {
            const StepPart& p = at.parts.front();
            if (p.values.size() < 3 || p.values[2].kind != StepKind::Reference) return;
            at = text_.entity(p.values[2].id, p.values[2].at);
        }
        if (!at.is("PRODUCT")) return;
        const StepPart& product = at.parts.front();
        frame.name = text_.name(product, 1);
        if (frame.name.empty()) frame.name = text_.name(product, 0);
    }

    /// Whether the assembly of the occurrence is the first representation and not the second.
    [[nodiscard]] bool is_turned(const Relation& r) const {
        const auto whole = whole_of_.find(r.entity.id);
        if (whole == whole_of_.end()) return false;
        return shown_.contains({whole->second, frame_of_.at(r.first)}) &&
               !shown_.contains({whole->second, frame_of_.at(r.second)});
    }

    struct Axes {
        std::array<Point3d, 3> direction{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        Point3d origin{};
    };

    static Point3d cross_product(const Point3d& a, const Point3d& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    Point3d normalized(const StepEntity& placement, Point3d v) const {
        const double length = std::hypot(v[0], v[1], v[2]);
        if (!(length > 1e-150) || !(length < 1e150))
            text_.fail(placement, "has axes without a direction");
        for (double& c : v) c /= length;
        return v;
    }

    static Point3d perpendicular(Point3d v, const Point3d& z) {
        const double along = v[0] * z[0] + v[1] * z[1] + v[2] * z[2];
        for (std::size_t k = 0; k < 3; ++k) v[k] -= along * z[k];
        return v;
    }

    Axes axes_of(const StepEntity& placement) const {
        if (!placement.is("AXIS2_PLACEMENT_3D")) text_.refuse(placement, "is not read as a place");
        const StepPart& part = placement.parts.front();
        Axes out;
        out.origin = shapes_.triple(text_.referred(placement, part, 1), "CARTESIAN_POINT");
        const auto given = [&](std::size_t i) -> std::optional<Point3d> {
            if (i >= part.values.size() || part.values[i].kind != StepKind::Reference)
                return std::nullopt;
            return normalized(placement,
                              shapes_.triple(text_.referred(placement, part, i), "DIRECTION"));
        };
        auto& [x, y, z] = out.direction;
        z = given(2).value_or(z);
        Point3d reference =
            given(3).value_or(z[1] == 0 && z[2] == 0 ? Point3d{0, 1, 0} : Point3d{1, 0, 0});
        x = perpendicular(reference, z);
        if (std::hypot(x[0], x[1], x[2]) < 1e-9) text_.fail(placement, "has parallel axes");
        x = normalized(placement, perpendicular(normalized(placement, x), z));
        y = cross_product(z, x);
        return out;
    }

    /// Takes the first placement to the second one.
    ExactAffine between(const StepEntity& first, const StepEntity& second) const {
        const Axes a = axes_of(first);
        const Axes b = axes_of(second);
        const Point3d& o = a.origin;
        const Point3d& t = b.origin;
        const auto& [u, v, w] = a.direction;
        const auto& [x, y, z] = b.direction;
        return ExactAffine::from_rows({1, 0, 0, -o[0], 0, 1, 0, -o[1], 0, 0, 1, -o[2]})
            .then(ExactAffine::from_rows(
                {u[0], u[1], u[2], 0, v[0], v[1], v[2], 0, w[0], w[1], w[2], 0}))
            .then(ExactAffine::from_rows(
                {x[0], y[0], z[0], t[0], x[1], y[1], z[1], t[1], x[2], y[2], z[2], t[2]}));
    }

    const StepText& text_;
    ModelReport unread_;
    StepShapes shapes_;
    std::map<std::uint64_t, Representation> representations_;
    std::vector<Relation> relations_;
    std::vector<StepEntity> dependents_;
    std::vector<StepEntity> definitions_;
    std::vector<std::size_t> parents_;
    std::map<std::uint64_t, std::size_t> frame_of_;
    std::map<std::uint64_t, std::uint64_t> whole_of_;        ///< by relationship
    std::set<std::pair<std::uint64_t, std::size_t>> shown_;  ///< product definition and frame
    std::vector<StepFrame> frames_;
};

}  // namespace

std::vector<StepFrame> step_frames(const StepText& text) { return AssemblyReader(text).read(); }

}  // namespace trisect::detail
