// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/embedding_findings.h>

#include <trisect/brep/validate/embedding.h>

namespace trisect {

EmbeddingFindings find_embedding(const LatticeMesh& mesh) {
    EmbeddingFindings out;
    out.is_embedded = is_embedded(mesh);
    if (!out.is_embedded) out.kinds = detail::facet_kinds(mesh);
    return out;
}

}  // namespace trisect
