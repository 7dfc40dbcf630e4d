// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/zip_archive.h>

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <zip.h>

#include <algorithm>
#include <array>
#include <new>
#include <set>

namespace trisect::detail {
namespace {

// Smaller entries may unpack to any multiple of their size: repeated text packs well.
constexpr std::uint64_t harmless = 1U << 20;

/// Of libzip's errors outside an archive.
class ZipError {
public:
    ZipError() { zip_error_init(&error_); }
    ~ZipError() { zip_error_fini(&error_); }
    ZipError(const ZipError&) = delete;
    ZipError& operator=(const ZipError&) = delete;
    [[nodiscard]] zip_error_t* get() { return &error_; }
    [[nodiscard]] std::string text() { return zip_error_strerror(&error_); }

private:
    zip_error_t error_{};
};

struct CloseFile {
    void operator()(zip_file_t* file) const { (void)zip_fclose(file); }
};
struct DiscardArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct FreeSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using ArchivePointer = std::unique_ptr<zip_t, DiscardArchive>;
using SourcePointer = std::unique_ptr<zip_source_t, FreeSource>;

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return out;
}

[[noreturn]] void fail_writing(zip_t* archive) {
    throw Error(ErrorCode::Internal, std::string("libzip: ") + zip_strerror(archive));
}

void add_entry(zip_t* archive, const std::string& name, const std::string& bytes) {
    zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    if (source == nullptr) fail_writing(archive);
    const zip_int64_t index = zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(source);
        fail_writing(archive);
    }
    const auto number = static_cast<zip_uint64_t>(index);
    constexpr zip_uint16_t first_day = (1 << 5) | 1;  // 1 January 1980
    if (zip_set_file_compression(archive, number, ZIP_CM_DEFLATE, 6) != 0 ||
        zip_file_set_dostime(archive, number, 0, first_day, 0) != 0)
        fail_writing(archive);
}

std::string all_bytes(zip_source_t* source) {
    std::string out;
    if (zip_source_open(source) != 0) throw Error(ErrorCode::Internal, "libzip: nothing written");
    std::array<char, 1U << 16> piece;
    for (;;) {
        const zip_int64_t got = zip_source_read(source, piece.data(), piece.size());
        if (got <= 0) break;
        out.append(piece.data(), static_cast<std::size_t>(got));
    }
    (void)zip_source_close(source);
    return out;
}

}  // namespace

struct ZipArchive::Handle {
    Handle() = default;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (archive != nullptr) zip_discard(archive);
    }
    zip_t* archive = nullptr;
};

ZipArchive::ZipArchive(std::string_view bytes, std::string name, const ReadLimits& limits)
    : name_(std::move(name)),
      limits_(limits),
      size_(bytes.size()),
      handle_(std::make_unique<Handle>()) {
    ZipError error;
    SourcePointer source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, error.get()));
    if (source == nullptr) throw std::bad_alloc();
    handle_->archive = zip_open_from_source(source.get(), ZIP_RDONLY, error.get());
    if (handle_->archive == nullptr) fail({}, "no zip archive: " + error.text());
    (void)source.release();  // the archive's now
    list_entries();
}

ZipArchive::~ZipArchive() = default;

void ZipArchive::list_entries() {
    const zip_int64_t count = zip_get_num_entries(handle_->archive, 0);
    if (static_cast<std::uint64_t>(std::max<zip_int64_t>(count, 0)) > limits_.archive_entries) {
        throw LimitError(name_ + ": more than " + std::to_string(limits_.archive_entries) +
                         " entries, the limit for an archive");
    }
    std::set<std::string> seen;
    for (zip_int64_t i = 0; i < count; ++i) {
        const char* const name =
            zip_get_name(handle_->archive, static_cast<zip_uint64_t>(i), ZIP_FL_ENC_GUESS);
        if (name == nullptr) fail({}, "an entry without a name");
        if (!seen.insert(lower_case(name)).second)
            fail({}, "two entries are called " + shown_word(name));
        entries_.emplace_back(name);
    }
}

std::string ZipArchive::name_of(std::string_view entry) const {
    return entry.empty() ? name_ : name_ + "/" + std::string(entry);
}

void ZipArchive::fail(std::string_view entry, const std::string& message) const {
    throw InputError(FilePlace{name_of(entry), 0, 0, 0}, message);
}

std::optional<std::string> ZipArchive::read(std::string_view entry) {
    zip_t* const archive = handle_->archive;
    const zip_int64_t found = zip_name_locate(archive, std::string(entry).c_str(), ZIP_FL_NOCASE);
    if (found < 0) return std::nullopt;
    const auto index = static_cast<zip_uint64_t>(found);
    zip_stat_t facts;
    zip_stat_init(&facts);
    constexpr zip_uint64_t wanted =
        ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    if (zip_stat_index(archive, index, 0, &facts) != 0 || (facts.valid & wanted) != wanted)
        fail(entry, std::string("unreadable: ") + zip_strerror(archive));
    if (facts.encryption_method != ZIP_EM_NONE) fail(entry, "encrypted, which is refused");
    if (facts.comp_method != ZIP_CM_STORE && facts.comp_method != ZIP_CM_DEFLATE)
        fail(entry, "packed in another way than 'deflated', which is refused");
    const std::unique_ptr<zip_file_t, CloseFile> file(zip_fopen_index(archive, index, 0));
    if (file == nullptr) fail(entry, std::string("unreadable: ") + zip_strerror(archive));
    const std::uint64_t packed = std::min<std::uint64_t>(facts.comp_size, size_);
    std::string out;
    std::array<char, 1U << 16> piece;
    for (;;) {
        check_stop();
        const zip_int64_t got = zip_fread(file.get(), piece.data(), piece.size());
        if (got == 0) return out;
        if (got < 0) fail(entry, std::string("damaged: ") + zip_file_strerror(file.get()));
        out.append(piece.data(), static_cast<std::size_t>(got));
        unpacked_ += static_cast<std::uint64_t>(got);
        if (unpacked_ > limits_.unpacked_bytes) {
            throw LimitError(name_of(entry) + ": the archive unpacks to more than " +
                             std::to_string(limits_.unpacked_bytes) + " bytes, the limit");
        }
        if (out.size() > harmless &&
            out.size() / std::max<std::uint64_t>(limits_.unpacked_ratio, 1) > packed) {
            throw LimitError(name_of(entry) + ": unpacks to more than " +
                             std::to_string(limits_.unpacked_ratio) + " times its size, the limit");
        }
    }
}

std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& entries) {
    ZipError error;
    SourcePointer source(zip_source_buffer_create(nullptr, 0, 0, error.get()));
    if (source == nullptr) throw std::bad_alloc();
    ArchivePointer archive(zip_open_from_source(source.get(), ZIP_TRUNCATE, error.get()));
    if (archive == nullptr) throw Error(ErrorCode::Internal, "libzip: " + error.text());
    zip_source_keep(source.get());
    for (const auto& [name, bytes] : entries) add_entry(archive.get(), name, bytes);
    if (zip_close(archive.get()) != 0) fail_writing(archive.get());
    (void)archive.release();  // freed by closing it
    return all_bytes(source.get());
}

}  // namespace trisect::detail
