// SPDX-License-Identifier: Apache-2.0
//
// CsgEvaluator: one formula for a program, and the shapes that are its operands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/csg/csg_extrude.h>
#include <trisect/bsp/csg/csg_frame.h>
#include <trisect/bsp/csg/csg_kept.h>
#include <trisect/bsp/csg/csg_node_progress.h>
#include <trisect/bsp/csg/csg_program.h>
#include <trisect/bsp/csg/drawing/drawing.h>

namespace trisect::detail {

/// The program, the options, the report and what is kept must outlive it.
class CsgEvaluator {
public:
    CsgEvaluator(const CsgProgram& program, const CsgOptions& options, CsgReport& report,
                 CsgKept& kept)
        : program_(program),
          options_(options),
          report_(report),
          kept_(kept),
          progress_(program, options) {}

    [[nodiscard]] Expression formula();
    [[nodiscard]] Solid run();

private:
    void remark(std::uint32_t n, const std::string& text);
    void remark(std::string text);
    void note_found(std::uint32_t n);
    [[nodiscard]] Solid solid_of(const Expression& formula);

    // Formulas of nodes.
    [[nodiscard]] std::vector<Expression> terms_of(const std::vector<std::uint32_t>& children,
                                                   int dimension, const CsgFrame& frame);
    [[nodiscard]] Expression any_of(const std::vector<std::uint32_t>& children, int dimension,
                                    const CsgFrame& frame);
    [[nodiscard]] Expression group(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Solid tinted(const Solid& solid, const CsgFrame& frame);
    [[nodiscard]] Expression children_of(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression expression_of(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression expression_of_kind(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression expression_or_empty(std::uint32_t n, const CsgFrame& frame);
    template <class Make>
    [[nodiscard]] Expression kept_formula(std::uint32_t n, const CsgFrame& frame, const Make& make);
    [[nodiscard]] Expression difference(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression intersection(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression turned(std::uint32_t n, const AffineMap& own, const CsgFrame& frame);
    [[nodiscard]] Solid turned_group(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] bool is_single(std::uint32_t n) const;

    // Shapes.
    /// \throw CsgError with the place of the node for what import refuses
    template <class Work>
    auto at_node(std::uint32_t n, Work&& work) const {
        try {
            return work();
        } catch (const CsgError&) {
            throw;
        } catch (const CancelledError&) {
            throw;
        } catch (const Error& e) {
            program_.arguments(n).fail(e.code(), e.what());
        }
    }
    [[nodiscard]] Solid placed(std::uint32_t n, PolygonMesh mesh, const CsgFrame& frame);
    [[nodiscard]] PolygonMesh mesh_of(std::uint32_t n);
    [[nodiscard]] Expression shape(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression region(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Drawing drawing_of(std::uint32_t n);
    [[nodiscard]] Expression named_drawing(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Drawing drawing_file(std::uint32_t n);
    [[nodiscard]] Expression prism_of_drawing(std::uint32_t n, Drawing drawing,
                                              const CsgFrame& frame);

    // What is made of children.
    [[nodiscard]] Expression linear(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression revolved(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] bool names_drawing(std::uint32_t n) const;
    [[nodiscard]] Expression flat_content(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Expression resolved(const Expression& formula);
    [[nodiscard]] PlaneRegion base_of(std::uint32_t n);
    [[nodiscard]] Expression hull(std::uint32_t n, const CsgFrame& frame);

    // What is made at the origin first, and put into place as a whole.
    [[nodiscard]] Expression made(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] Solid made_at_origin(std::uint32_t n);
    [[nodiscard]] std::vector<Solid> operands_of(std::uint32_t n);
    [[nodiscard]] Solid minkowski(std::uint32_t n);
    [[nodiscard]] Solid offset(std::uint32_t n);
    [[nodiscard]] std::optional<PolygonMesh> turned_mesh(std::uint32_t n);
    [[nodiscard]] std::optional<PolygonMesh> upright_mesh(std::uint32_t n);
    [[nodiscard]] std::optional<PolygonMesh> surface_at_ground(std::uint32_t n);
    [[nodiscard]] Solid projection(std::uint32_t n);
    [[nodiscard]] Expression resized(std::uint32_t n, const CsgFrame& frame);
    [[nodiscard]] std::filesystem::path file_named(std::uint32_t n);
    [[nodiscard]] PolygonMesh file_of(std::uint32_t n);

    // Many sections may be of one group.
    struct TurnedMesh {
        std::string key;
        ExactMesh mesh;
    };

    const CsgProgram& program_;
    const CsgOptions& options_;
    CsgReport& report_;
    CsgKept& kept_;
    TurnedMesh last_turned_;
    // Or of one height field, or one group that stands upright.
    struct KeptMesh {
        std::string key;
        PolygonMesh mesh;
    };
    KeptMesh last_mesh_;
    CsgNodeProgress progress_;
};

}  // namespace trisect::detail
