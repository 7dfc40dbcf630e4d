// SPDX-License-Identifier: Apache-2.0
#include "certificate.h"

#include <fmt/format.h>

#include <utility>

#include "values.h"

namespace trisect::app {

Certificate certify_output(const Brep& brep, PolygonMesh mesh, MeshFormat format) {
    const bool floats = format == MeshFormat::Stl || format == MeshFormat::StlBinary;
    return certify(brep, std::move(mesh), floats ? Precision::Float : Precision::Double);
}

Json to_json(const Certificate& c) {
    Json out;
    out["closed"] = c.closed;
    out["oriented"] = c.oriented;
    out["self_intersecting_pairs"] =
        c.self_intersecting_pairs ? Json(*c.self_intersecting_pairs) : Json();
    out["max_move"] = c.max_move;
    out["rounded_vertices"] = c.rounded_vertices;
    return out;
}

std::string to_text(const Certificate& c) {
    const std::string pairs = c.self_intersecting_pairs
                                  ? fmt::format("{}", *c.self_intersecting_pairs)
                                  : "an unknown number of";
    return fmt::format("{}, {}, {} self-intersecting pairs, {} vertices rounded by at most {}",
                       c.closed ? "closed" : "NOT closed", c.oriented ? "oriented" : "NOT oriented",
                       pairs, c.rounded_vertices, number_text(c.max_move));
}

}  // namespace trisect::app
