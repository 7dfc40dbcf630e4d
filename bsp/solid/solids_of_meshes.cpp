// SPDX-License-Identifier: Apache-2.0
//
// What takes time is shared: imports, and looking for what meets. Solids are numbered as they are
// made, so that is done in order afterwards.

#include <trisect/bsp/solids_of_meshes.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <trisect/brep/embedding_findings.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/bsp/solid_of_findings.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect {

namespace {

// Of a boundary that is right in itself.
struct LookedAt {
    std::optional<ImportedMesh> imported;
    std::optional<EmbeddingFindings> findings;  // where they serve
};

bool is_plain(const ImportReport& report) {
    return report.closed && !report.inside_out && report.t_edges == 0;
}

LookedAt look_at(const PolygonMesh& mesh, const SolidOptions& options,
                 const ImportOptions& import) {
    LookedAt out;
    out.imported = import_mesh(mesh, import);
    if (options.embedding == Embedding::Check && is_plain(out.imported->report))
        out.findings = find_embedding(out.imported->mesh);
    return out;
}

Solid solid_of(LookedAt made, const SolidOptions& options) {
    if (made.findings)
        return solid_of_findings(std::move(made.imported->mesh), *std::move(made.findings));
    return Solid::from_import(*std::move(made.imported), options.embedding, options.inside_out);
}

// So that what imports report takes little memory.
constexpr std::size_t most_at_once = 4096;

}  // namespace

std::vector<Solid> solids_of_meshes(std::span<const PolygonMesh> meshes,
                                    const SolidOptions& options) {
    ImportOptions import = options.import;
    import.require_closed = true;
    std::vector<Solid> out;
    out.reserve(meshes.size());
    if (meshes.size() < 2) {
        for (const PolygonMesh& m : meshes) out.push_back(Solid::from_mesh(m, options));
        return out;
    }
    const bool are_shared = detail::ParallelParts(meshes.size(), import.threads, 1).count() > 1;
    const std::uint32_t threads = std::exchange(import.threads, are_shared ? 1 : import.threads);
    std::vector<LookedAt> some(std::min(meshes.size(), most_at_once));
    while (!meshes.empty()) {
        const std::span these = meshes.first(std::min(meshes.size(), most_at_once));
        meshes = meshes.subspan(these.size());
        const detail::ParallelParts parts(these.size(), threads, 1);
        parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) some[i] = look_at(these[i], options, import);
        });
        for (std::size_t i = 0; i < these.size(); ++i)
            out.push_back(solid_of(std::exchange(some[i], {}), options));
    }
    return out;
}

}  // namespace trisect
