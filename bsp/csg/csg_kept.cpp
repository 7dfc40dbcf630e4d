// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_kept.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace trisect::detail {
namespace {

// What is used again moves to what is made now.
template <class Map>
const typename Map::mapped_type* found(Map& now, Map& before, const std::string& key) {
    if (const auto at = now.find(key); at != now.end()) return &at->second;
    const auto at = before.find(key);
    return at == before.end() ? nullptr : &now.insert(before.extract(at)).position->second;
}

}  // namespace

void CsgKept::begin() {
    before_ = have_files_changed() ? Made() : std::move(now_);
    now_ = Made();
    files_.clear();
}

const Solid* CsgKept::solid(const std::string& key) {
    return found(now_.solids, before_.solids, key);
}

const Expression* CsgKept::formula(const std::string& key) {
    return found(now_.formulas, before_.formulas, key);
}

const Solid& CsgKept::keep(const std::string& key, const Solid& solid) {
    return now_.solids.emplace(key, solid).first->second;
}

const Expression& CsgKept::keep_formula(const std::string& key, const Expression& formula) {
    return now_.formulas.emplace(key, formula).first->second;
}

std::int32_t CsgKept::number_of(const CsgColor& color) {
    const auto at = std::ranges::find(colors_, color);
    if (at != colors_.end()) return static_cast<std::int32_t>(at - colors_.begin());
    colors_.push_back(color);
    return static_cast<std::int32_t>(colors_.size()) - 1;
}

void CsgKept::note_color(std::uint32_t source, std::int32_t color) {
    if (color >= 0) color_of_source_[source] = static_cast<std::uint32_t>(color);
}

CsgKept::FileState CsgKept::state_of(const std::filesystem::path& file) {
    std::error_code none;
    FileState state;
    state.written = std::filesystem::last_write_time(file, none);
    state.size = std::filesystem::file_size(file, none);
    return state;
}

void CsgKept::note_file(const std::filesystem::path& file) {
    if (across_programs_) files_.emplace(file, state_of(file));
}

bool CsgKept::have_files_changed() const {
    return std::ranges::any_of(files_, [](const auto& f) { return f.second != state_of(f.first); });
}

}  // namespace trisect::detail
