// SPDX-License-Identifier: Apache-2.0
//
// All of an import is shared. Serials of sources are taken for all meshes beforehand, so that they
// are in the order of the meshes.

#include <trisect/bsp/solids_of_meshes.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/bsp/cells/serial_scope.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/ready_memory.h>

namespace trisect {

namespace {

// Small arrays of many meshes lie in the heap, which grows by small pages: their first touch, and
// the growing, take half of an import.
class HeapRoom {
public:
    // None where there is little to import.
    explicit HeapRoom(std::span<const PolygonMesh> meshes) {
        std::size_t corners = 0;
        for (const PolygonMesh& m : meshes) corners += m.corners.size();
        is_wanted_ = corners >= least_corners;
        if (is_wanted_) detail::keep_heap();
    }
    // In the heap of the calling thread, for what comes next.
    void make_ready() const {
        if (!is_wanted_) return;
        void* const array = std::malloc(room);
        if (array != nullptr) detail::make_ready(array, room);
        std::free(array);
    }

private:
    static constexpr std::size_t least_corners = std::size_t{1} << 21;
    static constexpr std::size_t room = std::size_t{3} << 23;
    bool is_wanted_ = false;
};

// After so many meshes room is made again.
constexpr std::size_t meshes_of_room = 64;

}  // namespace

std::vector<Solid> solids_of_meshes(std::span<const PolygonMesh> meshes,
                                    const SolidOptions& options) {
    ImportOptions import = options.import;
    import.require_closed = true;
    if (meshes.size() < 2) {
        std::vector<Solid> out;
        for (const PolygonMesh& m : meshes) out.push_back(Solid::from_mesh(m, options));
        return out;
    }
    const detail::ParallelParts parts(meshes.size(), import.threads, 1);
    if (parts.count() > 1) import.threads = 1;
    const HeapRoom room(meshes);
    const std::uint64_t serial = detail::Source::take_serials(meshes.size());
    std::vector<Solid> out(meshes.size());
    parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if ((i - begin) % meshes_of_room == 0) room.make_ready();
            ImportedMesh imported = import_mesh(meshes[i], import);
            const detail::SerialScope scope(serial + i);
            out[i] = Solid::from_import(std::move(imported), options.embedding, options.inside_out);
        }
    });
    return out;
}

}  // namespace trisect
