// SPDX-License-Identifier: Apache-2.0
//
// LazyModel: a solid with its B-rep, made when first needed.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include <trisect/brep/brep.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

struct InterferenceModelData;

/// Copies of an InterferenceModel share it. The B-rep is made first, then what questions need.
/// Threads may share it: one makes them, others wait.
class LazyModel {
public:
    /// \throw UnsupportedError when the solid is unbounded; what evaluate() throws, for a solid
    /// that must be resolved
    explicit LazyModel(const Solid& solid);
    explicit LazyModel(const BrepIndex& index);
    LazyModel(const LazyModel&) = delete;
    LazyModel& operator=(const LazyModel&) = delete;
    ~LazyModel();

    [[nodiscard]] const Solid& solid() const { return solid_; }
    /// \throw UnsupportedError, what Solid::to_brep throws
    [[nodiscard]] const Brep& brep() const;
    /// \throw what brep() throws
    [[nodiscard]] const InterferenceModelData& data() const;
    [[nodiscard]] const BrepIndex& index() const;
    /// Of Solid::to_brep.
    [[nodiscard]] double brep_seconds() const { return brep_seconds_; }

private:
    void expect_bounded() const;

    Solid solid_;
    mutable std::once_flag index_once_;
    mutable std::optional<BrepIndex> index_;
    mutable std::once_flag brep_once_;
    mutable std::optional<Brep> brep_;
    mutable double brep_seconds_ = 0;
    mutable std::once_flag data_once_;
    mutable std::unique_ptr<const InterferenceModelData> data_;
};

}  // namespace trisect::detail
