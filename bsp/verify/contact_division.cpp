// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/verify/contact_division.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

// Faces are divided at one place in each pass.
constexpr std::size_t max_passes = 16;

}  // namespace

double sum_up(double a, double b) {
    return b == 0 ? a : std::nextafter(a + b, std::numeric_limits<double>::infinity());
}

ValidationReport listed_defects(const PolygonMesh& mesh, const std::optional<Lattice>& lattice) {
    ValidateOptions validation;
    validation.list_limit = std::size_t{1} << 20U;
    validation.lattice = lattice;
    try {
        return validate(mesh, validation);
    } catch (const LimitError&) {
        validation.self_intersection = false;
        return validate(mesh, validation);
    }
}

ContactDivision::ContactDivision(PolygonMesh of, double grain,
                                 const std::optional<Lattice>& lattice,
                                 ContactInsertion::Rounding rounding)
    : mesh(std::move(of)),
      parents(mesh.face_count()),
      grain_(grain),
      lattice_(lattice),
      rounding_(std::move(rounding)) {
    std::iota(parents.begin(), parents.end(), 0U);
}

bool ContactDivision::run(double reach) {
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (std::size_t pass = 0; pass < max_passes; ++pass) {
        const ValidationReport report = listed_defects(mesh, lattice_);
        const std::size_t pairs = report.count(DefectKind::SelfIntersection);
        if (pass == 0) first_pairs = pairs;
        if (pass > 0 && pairs > 4 * least + 16) return false;
        least = std::min(least, pairs);
        if (!divide(report, reach)) return false;
        certificate = certify(mesh);
        if (certificate->holds()) return true;
    }
    return false;
}

bool ContactDivision::divide(const ValidationReport& report, double reach) {
    ContactInsertion insertion(mesh, reach, rounding_);
    for (const Defect& d : report.defects())
        if (d.faces.size() == 2 &&
            (d.kind == DefectKind::SelfIntersection || d.kind == DefectKind::FacesTouch))
            insertion.add(d.faces[0], d.faces[1]);
    if (insertion.is_empty()) return false;
    std::vector<std::uint32_t> of_pass;
    mesh = insertion.divided(&of_pass);
    for (std::uint32_t& parent : of_pass) parent = parents[parent];
    parents = std::move(of_pass);
    // Its distances are doubles' ones.
    moved = sum_up(moved, insertion.largest_move() * (1 + 0x1p-20) + grain_);
    return true;
}

}  // namespace trisect::detail
