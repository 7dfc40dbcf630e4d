// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/relation/lazy_model.h>

#include <chrono>

#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/seconds_since.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

namespace {

[[noreturn]] void refuse() {
    throw UnsupportedError("an unbounded solid has no interference model");
}

// A boundary that may cross itself is made free of that first.
Solid resolved(const Solid& solid) {
    return state_of(solid)->embedded ? solid : evaluate(Expression(solid));
}

// The volume below the faces of an unbounded solid with a bounded boundary is negative.
bool is_bounded(const Brep& brep) { return brep.is_empty() || sign_of_volume(brep) > 0; }

}  // namespace

LazyModel::LazyModel(const Solid& solid) : solid_(resolved(solid)) { expect_bounded(); }

LazyModel::LazyModel(const BrepIndex& index) : solid_(index.solid()), index_(index) {
    if (index.has_brep()) brep_ = index.brep();
    expect_bounded();
}

LazyModel::~LazyModel() = default;

// Whole planes that are listed have no bounds: whether they enclose something, the B-rep says.
void LazyModel::expect_bounded() const {
    const IndexBase base(solid_);
    if (solid_.is_empty()) return;
    if (solid_.is_whole_space() || (base.is_bounded() && base.is_inside_beyond())) refuse();
    if (!base.is_bounded()) (void)brep();
}

const Brep& LazyModel::brep() const {
    work_once(brep_once_, [this] {
        const auto start = std::chrono::steady_clock::now();
        if (!brep_) brep_ = solid_.to_brep();
        brep_seconds_ = seconds_since(start);
        if (!is_bounded(*brep_)) refuse();
    });
    return *brep_;
}

const InterferenceModelData& LazyModel::data() const {
    const Brep& boundary = brep();
    work_once(data_once_,
              [&] { data_ = std::make_unique<const InterferenceModelData>(*this, boundary); });
    return *data_;
}

const BrepIndex& LazyModel::index() const {
    work_once(index_once_, [this] {
        if (!index_) index_.emplace(solid_);
    });
    return *index_;
}

}  // namespace trisect::detail
