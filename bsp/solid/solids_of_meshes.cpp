// SPDX-License-Identifier: Apache-2.0
//
// All of an import is shared. Serials of sources are taken for all meshes beforehand, so that they
// are in the order of the meshes.
//
// A mesh that is larger than what one thread would have of all is imported by all threads, the
// others are imported side by side, each by one.

#include <trisect/bsp/solids_of_meshes.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/ready_memory.h>
#include <trisect/kernel/support/serial_scope.h>
#include <trisect/kernel/support/thread_pool.h>

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

// Fewer faces are not worth several threads.
constexpr std::size_t many_faces = 1 << 15;

class MeshesAtOnce {
public:
    MeshesAtOnce(std::span<const PolygonMesh> meshes, const SolidOptions& options)
        : meshes_(meshes),
          options_(options),
          serial_(detail::Source::take_serials(meshes.size())),
          out_(meshes.size()),
          failures_(meshes.size()) {}

    [[nodiscard]] std::vector<Solid> make() {
        const std::vector<std::size_t> others = make_large();
        const detail::ParallelParts parts(others.size(), options_.import.threads, 1);
        SolidOptions of_one = options_;
        if (parts.count() > 1) of_one.import.threads = 1;
        const HeapRoom room(meshes_);
        parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if ((i - begin) % meshes_of_room == 0) room.make_ready();
                make_one(others[i], of_one);
            }
        });
        for (const std::exception_ptr& failure : failures_)
            if (failure) std::rethrow_exception(failure);
        return std::move(out_);
    }

private:
    // By all threads, one after the other: those that have more than a quarter above a thread's
    // share of all faces. Returns the others.
    std::vector<std::size_t> make_large() {
        const std::uint32_t threads = options_.import.threads;
        const std::size_t slots = threads != 0 ? threads : detail::threads_here();
        std::size_t all = 0;
        for (const PolygonMesh& m : meshes_) all += m.face_count();
        std::vector<std::size_t> others;
        for (std::size_t i = 0; i < meshes_.size(); ++i) {
            const std::size_t faces = meshes_[i].face_count();
            if (slots > 1 && faces >= many_faces && 4 * slots * faces > 5 * all) {
                make_one(i, options_);
            } else {
                others.push_back(i);
            }
        }
        return others;
    }

    // Failures are kept: that of the first mesh is thrown.
    void make_one(std::size_t i, const SolidOptions& options) try {
        const detail::SerialScope scope(serial_ + i);
        out_[i] = Solid::from_mesh(meshes_[i], options);
    } catch (const CancelledError&) {
        throw;
    } catch (...) {
        failures_[i] = std::current_exception();
    }

    std::span<const PolygonMesh> meshes_;
    const SolidOptions& options_;
    std::uint64_t serial_;
    std::vector<Solid> out_;
    std::vector<std::exception_ptr> failures_;
};

}  // namespace

std::vector<Solid> solids_of_meshes(std::span<const PolygonMesh> meshes,
                                    const SolidOptions& options) {
    if (meshes.size() > 1) return MeshesAtOnce(meshes, options).make();
    std::vector<Solid> out;
    for (const PolygonMesh& m : meshes) out.push_back(Solid::from_mesh(m, options));
    return out;
}

}  // namespace trisect
