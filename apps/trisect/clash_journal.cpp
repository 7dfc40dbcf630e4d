// SPDX-License-Identifier: Apache-2.0
#include "clash_journal.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/output_file.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace trisect::app {
namespace {

std::string line_of(const Json& document) {
    return document.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json header_of(const std::string& key) {
    Json out;
    out["schema"] = "trisect.clash-journal/1";
    out["key"] = key;
    return out;
}

}  // namespace

ClashJournal::ClashJournal(std::string path, const std::string& key, bool resume)
    : path_(std::move(path)) {
    if (resume && std::filesystem::exists(path_)) read(key);
    // Again from the beginning, without what the last line lacked.
    std::string text = line_of(header_of(key));
    for (const auto& [piece, records] : done_)
        text += line_of(Json{{"piece", piece}, {"records", records}});
    write_file(path_, text, OutputSafety::Flushed);
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0)
        throw Error(ErrorCode::Input,
                    path_ + ": cannot write: " + std::generic_category().message(errno));
}

ClashJournal::~ClashJournal() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void ClashJournal::read(const std::string& key) {
    const FileBytes bytes = read_file(path_, ReadLimits().bytes);
    std::string_view rest = bytes.view();
    bool is_first = true;
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
        const Json line = Json::parse(rest.substr(0, end), nullptr, false);
        rest.remove_prefix(end + 1);
        if (is_first && (line.is_discarded() || line != header_of(key)))
            throw UsageError(path_ +
                             " is of another run: the manifest, a file or an option has changed; "
                             "leave --resume out to begin anew");
        if (!is_first && !line.is_discarded() && line.contains("piece"))
            done_[line.at("piece").get<std::size_t>()] = line.at("records");
        is_first = false;
    }
}

const Json* ClashJournal::done(std::size_t piece) const {
    const auto at = done_.find(piece);
    return at != done_.end() ? &at->second : nullptr;
}

void ClashJournal::add(std::size_t piece, Json records) {
    append(line_of(Json{{"piece", piece}, {"records", records}}));
    done_[piece] = std::move(records);
}

void ClashJournal::append(const std::string& line) {
    write_descriptor(descriptor_, path_, line);
    const auto now = std::chrono::steady_clock::now();
    if (now - flushed_ < std::chrono::seconds(1)) return;
    (void)::fdatasync(descriptor_);
    flushed_ = now;
}

void ClashJournal::remove() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

}  // namespace trisect::app
