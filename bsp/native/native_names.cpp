// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/native/native_names.h>

#include <trisect/bsp/cells/source.h>

namespace trisect::detail {

NativeNameMap::NativeNameMap(const NativeView& view, std::span<const SourceRecord> sources,
                             bool fresh) {
    const auto add = [this](std::uint32_t operand) {
        if (operands_.empty() || operands_.back() != operand) operands_.push_back(operand);
    };
    if (view.header().source != 0) add(view.header().source);
    for (const SourceRecord& s : sources) add(s.operand);
    for (std::uint64_t i = 0; i < view.header().count(NativeSection::Names); ++i)
        add(name_record(view, i).operand);
    std::ranges::sort(operands_);
    operands_.erase(std::unique(operands_.begin(), operands_.end()), operands_.end());
    if (operands_.empty()) return;
    if (fresh)
        first_ = Source::take_serials(operands_.size());
    else
        Source::reserve_serials(operands_.back());
}

FaceSource name_record(const NativeView& view, std::uint64_t number) {
    NativeCursor from(view.records(NativeSection::Names, number, 1));
    FaceSource n;
    n.operand = from.next<std::uint32_t>();
    n.face = from.next<std::uint32_t>();
    return n;
}

}  // namespace trisect::detail
