// SPDX-License-Identifier: Apache-2.0
#include "certificate.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <utility>

#include "values.h"

namespace trisect::app {

namespace {

Precision precision_of(MeshFormat format) {
    return holds_floats(format) ? Precision::Float : Precision::Double;
}

const char* name_of(CertifiedRounding::Outcome outcome) {
    switch (outcome) {
        case CertifiedRounding::Outcome::Plain:
            return "plain";
        case CertifiedRounding::Outcome::Gridded:
            return "gridded";
        case CertifiedRounding::Outcome::Repaired:
            return "repaired";
        default:
            return "failed";
    }
}

const char* reason_of(Undecided undecided) {
    return undecided == Undecided::Work
               ? "too many faces are near each other to compare them all"
               : "the written coordinates span too many bits for an exact check";
}

}  // namespace

Certificate certify_output(const Brep& brep, PolygonMesh mesh, MeshFormat format) {
    return certify(brep, std::move(mesh), precision_of(format));
}

Certificate certify_output(const ExactMesh& exact, PolygonMesh mesh, MeshFormat format) {
    return certify(exact, std::move(mesh), precision_of(format));
}

std::optional<Mending> mend_output(PolygonMesh& mesh, std::vector<FaceSource>& sources,
                                   Certificate& certificate, MeshFormat format) {
    if (certificate.holds()) return std::nullopt;
    std::optional<MendedRounding> mended = mended_rounding(mesh, certificate, precision_of(format));
    if (!mended) return std::nullopt;
    mesh = std::move(mended->mesh);
    certificate = mended->certificate;
    if (!sources.empty()) {
        std::vector<FaceSource> of_parts;
        of_parts.reserve(mended->parents.size());
        for (const std::uint32_t parent : mended->parents) of_parts.push_back(sources[parent]);
        sources = std::move(of_parts);
    }
    return Mending{mended->divided, mended->gave_thin_up, mended->radius};
}

CertifiedRounding round_output(const Brep& brep, MeshFormat format,
                               const EvaluateOptions& evaluation) {
    RoundingOptions options;
    options.precision = precision_of(format);
    options.evaluate = evaluation;
    return certified_rounding(brep, options);
}

Json to_json(const CertifiedRounding& r) {
    Json out;
    out["outcome"] = name_of(r.outcome);
    out["radius"] = r.radius;
    out["unit"] = r.unit;
    out["rounds"] = r.rounds;
    out["snapped_vertices"] = r.snapped_vertices;
    out["first_pairs"] = r.first_pairs;
    return out;
}

std::string to_text(const CertifiedRounding& r) {
    std::string out =
        fmt::format("{}, the set moved by at most {}", name_of(r.outcome), number_text(r.radius));
    if (r.unit > 0) out += fmt::format(", coordinates are multiples of {}", number_text(r.unit));
    if (r.rounds > 0)
        out += fmt::format("; {} pairs of faces met, {} rounds, {} vertices snapped", r.first_pairs,
                           r.rounds, r.snapped_vertices);
    return out;
}

Json to_json(const std::optional<Mending>& mending) {
    Json out;
    if (mending) out["radius"] = mending->radius;
    return out;
}

std::string to_text(const Mending& mending) {
    std::string out;
    if (mending.gave_thin_up) out = "triangles thinner than the rounding are given up; ";
    if (mending.divided > 0)
        out += fmt::format("edges lie in faces: these have {} triangles more; ", mending.divided);
    return out + fmt::format("the set moved by at most {}", number_text(mending.radius));
}

Json to_json(const Certificate& c) {
    Json out;
    out["certified"] = c.holds();
    out["closed"] = c.closed;
    out["oriented"] = c.oriented;
    out["self_intersecting_pairs"] =
        c.self_intersecting_pairs ? Json(*c.self_intersecting_pairs) : Json();
    out["undecided"] = c.undecided == Undecided::No ? Json() : Json(reason_of(c.undecided));
    out["max_move"] = c.max_move;
    out["rounded_vertices"] = c.rounded_vertices;
    return out;
}

std::string to_text(const Certificate& c) {
    const std::string pairs =
        c.self_intersecting_pairs
            ? fmt::format("{} self-intersecting pairs", *c.self_intersecting_pairs)
            : fmt::format("whether it meets itself is NOT known ({})", reason_of(c.undecided));
    return fmt::format("{}{}, {}, {}, {} vertices rounded by at most {}",
                       c.holds() ? "" : "NO: ", c.closed ? "closed" : "NOT closed",
                       c.oriented ? "oriented" : "NOT oriented", pairs, c.rounded_vertices,
                       number_text(c.max_move));
}

}  // namespace trisect::app
