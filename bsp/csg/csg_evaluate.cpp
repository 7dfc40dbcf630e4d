// SPDX-License-Identifier: Apache-2.0
//
// Matrices go down to the shapes, so that a program is one formula over meshes. That is right as
// long as a matrix changes axes, moves and scales: what was flush stays flush. Below a matrix that
// turns otherwise rounded corners would come apart, so a group is evaluated first, where it is
// flush, and turned as a whole.
#include <trisect/bsp/csg/csg_evaluate.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/solid_transform.h>

#include <trisect/bsp/csg/csg_arguments.h>
#include <trisect/bsp/csg/csg_extrude.h>
#include <trisect/bsp/csg/csg_shapes.h>

namespace trisect {
namespace {

using detail::CsgArguments;

constexpr std::size_t most_remarks = 100;

enum class Kind : std::uint8_t {
    Group,
    Difference,
    Intersection,
    Matrix,
    Hull,
    Linear,
    Revolved,
    Solid,
    Flat,
    Unknown
};

Kind kind_of(const std::string& name) {
    static const std::map<std::string, Kind, std::less<>> kinds{
        {"group", Kind::Group},
        {"union", Kind::Group},
        {"color", Kind::Group},
        {"render", Kind::Group},
        {"difference", Kind::Difference},
        {"intersection", Kind::Intersection},
        {"multmatrix", Kind::Matrix},
        {"hull", Kind::Hull},
        {"linear_extrude", Kind::Linear},
        {"rotate_extrude", Kind::Revolved},
        {"cube", Kind::Solid},
        {"sphere", Kind::Solid},
        {"cylinder", Kind::Solid},
        {"polyhedron", Kind::Solid},
        {"square", Kind::Flat},
        {"circle", Kind::Flat},
        {"polygon", Kind::Flat}};
    const auto it = kinds.find(name);
    return it == kinds.end() ? Kind::Unknown : it->second;
}

/// Where shapes are put: those of the plane become prisms between two heights first.
struct Frame {
    AffineMap map;
    double low = 0;
    double high = 1;
};

/// Whether each new axis is one of the old ones.
bool changes_axes(const AffineMap& map) {
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& row = map.rows[k];
        const auto used = [](double c) { return c != 0; };
        if (std::count_if(row.begin(), row.begin() + 3, used) != 1) return false;
    }
    return true;
}

class Evaluator {
public:
    Evaluator(const CsgTree& tree, const EvaluateOptions& options, CsgReport& report)
        : tree_(tree), options_(options), report_(report) {}

    Solid run() {
        report_.nodes = tree_.nodes.size();
        const std::vector<std::uint32_t> roots = chosen_roots();
        refuse_unknown(roots);
        find_dimensions();
        const int dimension = dimension_of(roots);
        report_.is_flat = dimension == 2;
        return solid_of(any_of(roots, dimension, Frame()));
    }

private:
    [[nodiscard]] const CsgNode& node(std::uint32_t n) const { return tree_.nodes[n]; }
    [[nodiscard]] CsgArguments arguments(std::uint32_t n) const { return {tree_, node(n)}; }
    [[nodiscard]] static bool is_used(const CsgNode& node) {
        return !node.modifiers.disabled && !node.modifiers.background;
    }

    /// Nodes of the subtrees that count, parents first.
    [[nodiscard]] std::vector<std::uint32_t> used_nodes(std::vector<std::uint32_t> todo) const {
        std::vector<std::uint32_t> out;
        while (!todo.empty()) {
            const std::uint32_t n = todo.back();
            todo.pop_back();
            if (!is_used(node(n))) continue;
            out.push_back(n);
            todo.insert(todo.end(), node(n).children.rbegin(), node(n).children.rend());
        }
        return out;
    }

    /// "!" makes its node the whole program, without what is around it.
    [[nodiscard]] std::vector<std::uint32_t> chosen_roots() const {
        for (const std::uint32_t n : used_nodes(tree_.roots))
            if (node(n).modifiers.root) return {n};
        return tree_.roots;
    }

    void refuse_unknown(const std::vector<std::uint32_t>& roots) const {
        for (const std::uint32_t n : used_nodes(roots))
            if (kind_of(node(n).name) == Kind::Unknown)
                throw CsgError(ErrorCode::Unsupported, tree_.place(node(n).place),
                               node(n).name.substr(0, 40) + "() is not supported");
    }

    void find_dimensions() {
        dimensions_.assign(tree_.nodes.size(), 0);
        for (std::size_t n = tree_.nodes.size(); n-- > 0;) {
            const Kind kind = kind_of(tree_.nodes[n].name);
            if (kind == Kind::Flat) dimensions_[n] = 2;
            if (kind == Kind::Solid || kind == Kind::Linear || kind == Kind::Revolved)
                dimensions_[n] = 3;
            if (dimensions_[n] == 0) dimensions_[n] = dimension_of(tree_.nodes[n].children);
        }
    }
    /// That of the first child that has one; 0 when nothing is there.
    [[nodiscard]] int dimension_of(const std::vector<std::uint32_t>& children) const {
        for (const std::uint32_t n : children)
            if (is_used(node(n)) && dimensions_[n] != 0) return dimensions_[n];
        return 0;
    }

    void remark(std::uint32_t n, const std::string& text) {
        if (report_.remarks.size() < most_remarks)
            report_.remarks.push_back(tree_.place(node(n).place).to_string() + ": " + node(n).name +
                                      ": " + text);
    }

    [[nodiscard]] Solid solid_of(const Expression& formula) {
        ++report_.evaluations;
        return evaluate(formula, options_);
    }

    [[nodiscard]] std::vector<Expression> terms_of(const std::vector<std::uint32_t>& children,
                                                   int dimension, const Frame& frame) {
        std::vector<Expression> out;
        for (const std::uint32_t n : children) {
            if (!is_used(node(n))) continue;
            if (dimensions_[n] != 0 && dimensions_[n] != dimension) {
                remark(n, "left out, since it is of another dimension than what is before it");
                continue;
            }
            out.push_back(expression_of(n, frame));
        }
        return out;
    }

    [[nodiscard]] Expression any_of(const std::vector<std::uint32_t>& children, int dimension,
                                    const Frame& frame) {
        return joined(terms_of(children, dimension, frame));
    }
    [[nodiscard]] static Expression joined(const std::vector<Expression>& terms) {
        if (terms.empty()) return Solid();
        return terms.size() == 1 ? terms[0] : Expression::any_of(terms);
    }

    [[nodiscard]] Expression expression_of(std::uint32_t n, const Frame& frame) {
        const std::vector<std::uint32_t>& children = node(n).children;
        switch (kind_of(node(n).name)) {
            case Kind::Group:
                return any_of(children, dimensions_[n], frame);
            case Kind::Difference: {
                std::vector<Expression> terms = terms_of(children, dimensions_[n], frame);
                if (terms.size() < 2) return joined(terms);
                const Expression first = terms.front();
                terms.erase(terms.begin());
                return first - joined(terms);
            }
            case Kind::Intersection: {
                const std::vector<Expression> terms = terms_of(children, dimensions_[n], frame);
                return terms.size() < 2 ? joined(terms) : Expression::all_of(terms);
            }
            case Kind::Matrix:
                return turned(n, frame);
            case Kind::Hull:
                return hull(n, frame);
            case Kind::Linear:
                return linear(n, frame);
            case Kind::Revolved: {
                const Solid prism = solid_of(any_of(children, 2, Frame()));
                return placed(n, detail::csg_revolved(detail::region_of_prism(prism), arguments(n)),
                              frame.map);
            }
            case Kind::Solid:
                return shape(n, frame);
            case Kind::Flat:
                return region(n, frame);
            case Kind::Unknown:
                break;
        }
        return Solid();
    }

    // ---- matrices

    [[nodiscard]] AffineMap matrix_of(std::uint32_t n) const {
        const CsgArguments in = arguments(n);
        const CsgValue* value = in.first();
        if (value == nullptr) value = in.find("m");
        AffineMap map;
        if (value == nullptr) return map;
        const CsgValue::List& rows = in.list(*value);
        if (rows.size() < 3) in.fail(ErrorCode::Input, value->place, "a matrix was expected");
        for (std::size_t k = 0; k < 3; ++k) {
            const std::vector<double> row = in.numbers(rows[k], 4);
            std::copy_n(row.begin(), 4, map.rows[k].begin());
        }
        if (rows.size() > 3 && in.numbers(rows[3], 4) != std::vector<double>{0, 0, 0, 1})
            in.fail(ErrorCode::Unsupported, rows[3].place, "the last row must be 0, 0, 0, 1");
        if (dimensions_[n] == 2) {  // in the plane
            for (std::size_t k = 0; k < 2; ++k) map.rows[k][2] = 0;
            map.rows[2] = {0, 0, 1, 0};
        }
        return map;
    }

    /// Whether there is one shape only, so that there is nothing to be flush with.
    [[nodiscard]] bool is_single(std::uint32_t n) const {
        const Kind kind = kind_of(node(n).name);
        if (kind == Kind::Solid || kind == Kind::Flat || kind == Kind::Revolved ||
            kind == Kind::Hull)
            return true;
        if (kind == Kind::Linear && !detail::is_straight(arguments(n))) return true;
        std::vector<std::uint32_t> used;
        for (const std::uint32_t c : node(n).children)
            if (is_used(node(c))) used.push_back(c);
        return used.empty() || (used.size() == 1 && is_single(used[0]));
    }

    [[nodiscard]] Expression turned(std::uint32_t n, const Frame& frame) {
        const AffineMap own = matrix_of(n);
        const AffineMap map = compose(frame.map, own);
        if (map.orientation() == 0) {
            remark(n, "left out, since the matrix makes it flat");
            return Solid();
        }
        if (changes_axes(map) || is_single(n))
            return any_of(node(n).children, dimensions_[n], {map, frame.low, frame.high});
        const std::string key = key_of(n, {AffineMap(), frame.low, frame.high}, true);
        auto it = solids_.find(key);
        if (it == solids_.end()) {
            const Solid solid = solid_of(
                any_of(node(n).children, dimensions_[n], {AffineMap(), frame.low, frame.high}));
            it = solids_.emplace(key, solid).first;
        }
        return it->second.is_empty() ? it->second : transformed(it->second, map);
    }

    // ---- content of subtrees

    static void add_number(std::string& key, double v) {
        key.append(reinterpret_cast<const char*>(&v), sizeof v);
    }
    static void add_value(std::string& key, const CsgValue& value) {
        key += static_cast<char>('0' + value.data.index());
        if (value.truth() != nullptr) key += *value.truth() ? 't' : 'f';
        if (value.number() != nullptr) add_number(key, *value.number());
        if (value.text() != nullptr) {
            add_number(key, static_cast<double>(value.text()->size()));
            key += *value.text();
        }
        if (value.list() != nullptr) {
            for (const CsgValue& v : *value.list()) add_value(key, v);
            key += ']';
        }
    }
    void add_node(std::string& key, std::uint32_t n, bool without_matrix) const {
        key += node(n).name;
        key += '(';
        if (!without_matrix)
            for (const CsgArgument& a : node(n).arguments) {
                key += a.name;
                key += '=';
                add_value(key, a.value);
            }
        key += '{';
        for (const std::uint32_t c : node(n).children)
            if (is_used(node(c))) add_node(key, c, false);
        key += '}';
    }
    /// Equal for equal subtrees in equal places.
    [[nodiscard]] std::string key_of(std::uint32_t n, const Frame& frame,
                                     bool without_matrix = false) const {
        std::string key;
        for (const auto& row : frame.map.rows)
            for (const double c : row) add_number(key, c);
        add_number(key, frame.low);
        add_number(key, frame.high);
        add_node(key, n, without_matrix);
        return key;
    }

    // ---- shapes

    /// \throw CsgError with the place of the node for what import refuses
    template <class Work>
    [[nodiscard]] auto at_node(std::uint32_t n, Work&& work) const {
        try {
            return work();
        } catch (const CsgError&) {
            throw;
        } catch (const CancelledError&) {
            throw;
        } catch (const Error& e) {
            arguments(n).fail(e.code(), e.what());
        }
    }

    [[nodiscard]] Solid placed(std::uint32_t n, const PolygonMesh& mesh, const AffineMap& map) {
        if (mesh.face_count() == 0) {
            remark(n, "is empty");
            return {};
        }
        SolidOptions options;
        options.embedding = Embedding::Check;
        return at_node(n, [&] {
            return map == AffineMap() ? Solid::from_mesh(mesh, options)
                                      : Solid::from_mesh(transformed(mesh, map), options);
        });
    }

    [[nodiscard]] PolygonMesh mesh_of(std::uint32_t n) const {
        const std::string& name = node(n).name;
        if (name == "cube") return detail::csg_cube(arguments(n));
        if (name == "sphere") return detail::csg_sphere(arguments(n));
        if (name == "cylinder") return detail::csg_cylinder(arguments(n));
        return detail::csg_polyhedron(arguments(n));
    }

    [[nodiscard]] Expression shape(std::uint32_t n, const Frame& frame) {
        ++report_.leaves;
        const std::string key = key_of(n, frame);
        const auto it = solids_.find(key);
        if (it != solids_.end()) return it->second;
        ++report_.meshes;
        return solids_.emplace(key, placed(n, mesh_of(n), frame.map)).first->second;
    }

    [[nodiscard]] std::vector<Outline> outlines_of(std::uint32_t n) const {
        const std::string& name = node(n).name;
        if (name == "square") return detail::csg_square(arguments(n));
        if (name == "circle") return detail::csg_circle(arguments(n));
        return detail::csg_polygon(arguments(n));
    }

    /// Where an odd number of paths go around.
    [[nodiscard]] Expression region(std::uint32_t n, const Frame& frame) {
        ++report_.leaves;
        const std::string key = key_of(n, frame);
        const auto it = regions_.find(key);
        if (it != regions_.end()) return it->second;
        ++report_.meshes;
        std::vector<Expression> terms;
        for (Outline& outline : outlines_of(n)) {
            outline.erase(std::unique(outline.begin(), outline.end()), outline.end());
            while (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
            if (outline.size() >= 3) terms.push_back(even_odd(n, outline, frame));
        }
        if (terms.empty()) remark(n, "is empty");
        return regions_.emplace(key, odd_of(terms)).first->second;
    }

    [[nodiscard]] static Expression odd_of(std::vector<Expression> terms) {
        if (terms.empty()) return Solid();
        while (terms.size() > 1) {
            std::vector<Expression> pairs;
            for (std::size_t i = 0; i + 1 < terms.size(); i += 2)
                pairs.push_back(terms[i] ^ terms[i + 1]);
            if (terms.size() % 2 == 1) pairs.push_back(terms.back());
            terms = std::move(pairs);
        }
        return terms[0];
    }

    /// Nothing when it has no area.
    [[nodiscard]] static std::optional<PolygonMesh> prism(const Outline& outline,
                                                          const Frame& frame) {
        try {
            return transformed(make_extrusion(outline, {}, frame.low, frame.high), frame.map);
        } catch (const UsageError&) {
            return std::nullopt;
        }
    }

    /// A simple polygon is a prism; any other one is an odd number of the triangles of a fan.
    [[nodiscard]] Expression even_odd(std::uint32_t n, const Outline& outline, const Frame& frame) {
        if (const auto mesh = prism(outline, frame)) {
            ImportedMesh imported = at_node(n, [&] { return import_mesh(*mesh); });
            if (is_embedded(imported.mesh)) return Solid::from_import(std::move(imported));
        }
        std::vector<Expression> triangles;
        for (std::size_t i = 1; i + 1 < outline.size(); ++i)
            if (const auto mesh = prism({outline[0], outline[i], outline[i + 1]}, frame))
                triangles.push_back(placed(n, *mesh, AffineMap()));
        return odd_of(triangles);
    }

    // ---- what is made of children

    [[nodiscard]] Expression linear(std::uint32_t n, const Frame& frame) {
        const CsgArguments in = arguments(n);
        const double height = in.number("height", 100);
        if (!(height > 0)) {
            remark(n, "is empty");
            return Solid();
        }
        const double low = in.truth("center", false) ? -height / 2 : 0;
        if (detail::is_straight(in))
            return any_of(node(n).children, 2, {frame.map, low, low + height});
        const Solid base = solid_of(any_of(node(n).children, 2, Frame()));
        return placed(n, detail::csg_twisted(detail::region_of_prism(base), in, low, low + height),
                      frame.map);
    }

    [[nodiscard]] Expression hull(std::uint32_t n, const Frame& frame) {
        std::vector<Point3d> points;
        for (const std::uint32_t c : node(n).children) {
            if (!is_used(node(c)) || (dimensions_[c] != 0 && dimensions_[c] != dimensions_[n]))
                continue;
            const Solid solid = solid_of(expression_of(c, frame));
            const PolygonMesh mesh = solid.to_mesh();
            points.insert(points.end(), mesh.points.begin(), mesh.points.end());
        }
        if (points.empty()) return Solid();
        return at_node(n, [&] { return placed(n, make_hull(points), AffineMap()); });
    }

    const CsgTree& tree_;
    const EvaluateOptions& options_;
    CsgReport& report_;
    std::vector<int> dimensions_;
    std::map<std::string, Solid> solids_;
    std::map<std::string, Expression> regions_;
};

}  // namespace

Solid evaluate_csg(const CsgTree& tree, const EvaluateOptions& options, CsgReport* report) {
    CsgReport own;
    CsgReport& out = report == nullptr ? own : *report;
    out = CsgReport();
    return Evaluator(tree, options, out).run();
}

}  // namespace trisect
