// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/properties/beside_files.h>

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <fstream>

namespace trisect::detail {
namespace {

constexpr std::size_t most_remarks = 20;

}  // namespace

std::optional<std::filesystem::path> BesideFiles::path_of(std::string_view name) const {
    if (!folder_ || name.empty() || name.find('\0') != std::string_view::npos) return std::nullopt;
    std::string slashed(name);
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    const std::filesystem::path path(slashed);
    if (path.is_absolute() || slashed.find(':') != std::string::npos) return std::nullopt;
    if (std::find(path.begin(), path.end(), "..") != path.end()) return std::nullopt;
    std::error_code error;
    const std::filesystem::path whole = *folder_ / path;
    if (!std::filesystem::is_regular_file(whole, error) || error) return std::nullopt;
    return whole;
}

bool BesideFiles::is_there(std::string_view name) const { return path_of(name).has_value(); }

std::optional<std::string> BesideFiles::read(std::string_view name) {
    const auto path = path_of(name);
    if (!path) {
        if (folder_) remark("there is no file " + shown_word(name) + " beside it");
        return std::nullopt;
    }
    std::ifstream in(*path, std::ios::binary);
    std::string bytes;
    char block[65536];
    while (in.read(block, sizeof block) || in.gcount() > 0) {
        const auto n = static_cast<std::uint64_t>(in.gcount());
        if (n > left_)
            throw LimitError(path->string() +
                             ": files that another one names have more bytes than the limit for a "
                             "file");
        left_ -= n;
        bytes.append(block, static_cast<std::size_t>(n));
    }
    if (in.bad()) throw InputError(FilePlace{path->string(), 0, 0, 0}, "cannot be read");
    return bytes;
}

void BesideFiles::remark(std::string text) {
    const auto& known = *remarks_;
    if (known.size() >= most_remarks || std::count(known.begin(), known.end(), text) != 0) return;
    remarks_->push_back(std::move(text));
}

}  // namespace trisect::detail
