// SPDX-License-Identifier: Apache-2.0
//
// NativeFragments: parts of facets of a native file, checked.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/native/native_records.h>

namespace trisect::detail {

/// Keeps all fragments until lists do.
class NativeFragments {
public:
    NativeFragments(const NativeView& view, std::span<const std::shared_ptr<const Source>> sources,
                    std::uint32_t threads);
    NativeFragments(const NativeFragments&) = delete;
    NativeFragments& operator=(const NativeFragments&) = delete;
    ~NativeFragments();

    /// One of them as a part of a facet. The planes of its edges are compared with the facet's when
    /// it is first used: neighbours meet in a point, and it is where the file says, within its
    /// error. Safe from any thread. \throw InputError
    [[nodiscard]] const Fragment* at(std::uint32_t number, std::uint32_t source,
                                     std::uint32_t facet) const;

private:
    [[nodiscard]] const Fragment* read(std::uint64_t number) const;
    [[nodiscard]] EdgeName edge(std::uint64_t number, Approximation& begin) const;
    void check(std::uint32_t number, const Plane& support) const;
    void release_all();

    const NativeView& view_;
    std::span<const std::shared_ptr<const Source>> sources_;
    std::vector<const Fragment*> fragments_;
    // Source and facet that a fragment was compared with, plus one; 0: none yet.
    mutable std::unique_ptr<std::atomic<std::uint64_t>[]> facet_of_;
};

}  // namespace trisect::detail
