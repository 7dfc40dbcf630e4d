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
    out["schema"] = "trisect.clash-journal/3";
    out["key"] = key;
    return out;
}

Json piece_of(std::uint64_t piece, const Json& records) {
    return Json{{"piece", piece}, {"records", records}};
}

}  // namespace

FinishedPieces read_clash_journal(const std::string& path, const std::string& key) {
    FinishedPieces out;
    if (!std::filesystem::exists(path)) return out;
    const FileBytes bytes = read_file(path, ReadLimits().bytes);
    std::string_view rest = bytes.view();
    bool is_first = true;
    for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
        Json line = Json::parse(rest.substr(0, end), nullptr, false);
        rest.remove_prefix(end + 1);
        if (is_first && (line.is_discarded() || line != header_of(key)))
            throw UsageError(path +
                             " is of another run: the manifest, a file or an option has changed; "
                             "leave --resume out to begin anew");
        if (!is_first && line.is_object() && line.contains("piece") && line.contains("records") &&
            line.at("piece").is_number_unsigned())
            out[line.at("piece").get<std::uint64_t>()] = std::move(line.at("records"));
        is_first = false;
    }
    return out;
}

ClashJournal::ClashJournal(std::string path, const std::string& key, const FinishedPieces& kept)
    : path_(std::move(path)) {
    std::string text = line_of(header_of(key));
    for (const auto& [piece, records] : kept) text += line_of(piece_of(piece, records));
    write_file(path_, text, OutputSafety::Flushed);
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0)
        throw Error(ErrorCode::Input,
                    path_ + ": cannot write: " + std::generic_category().message(errno));
}

ClashJournal::~ClashJournal() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void ClashJournal::add(std::uint64_t piece, const Json& records) { add(entry(piece, records)); }

std::string ClashJournal::entry(std::uint64_t piece, const Json& records) {
    return line_of(piece_of(piece, records));
}

void ClashJournal::add(const std::string& entries) {
    write_descriptor(descriptor_, path_, entries);
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
