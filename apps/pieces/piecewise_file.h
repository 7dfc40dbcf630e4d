// SPDX-License-Identifier: Apache-2.0
//
// InputFile, OutputStream and OutputPart: files larger than memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace trisect::app {

/// A file that is read at any place; every failure names it.
class InputFile {
public:
    /// \throw InputError
    explicit InputFile(std::string name);
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// All bytes of a part. \throw InputError where there are fewer
    void read(std::uint64_t offset, std::span<char> bytes) const;
    /// The whole file as memory that nothing is written to.
    [[nodiscard]] const char* mapped() const;
    /// Gives back what is in memory of that; it is read again where it is needed.
    void release() const;

private:
    std::string name_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    mutable void* mapping_ = nullptr;
};

/// A file that is written from its beginning, in large pieces.
class OutputStream {
public:
    /// Under a temporary name in the same folder. \throw Error (Input)
    explicit OutputStream(std::string name);
    OutputStream(const OutputStream&) = delete;
    OutputStream& operator=(const OutputStream&) = delete;
    /// Takes back what was not finished.
    ~OutputStream();

    void write(const void* bytes, std::size_t count);
    template <class T>
    void write(const T& value) {
        write(&value, sizeof value);
    }
    /// Flushes it to the disk and gives it its name.
    void finish();

private:
    void flush();
    [[noreturn]] void fail() const;

    std::string name_;
    std::string temporary_;
    int descriptor_ = -1;
    std::string buffer_;
};

/// A part of a file that others write to as well, from a place on.
class OutputPart {
public:
    /// \throw Error (Input)
    OutputPart(std::string name, std::uint64_t offset);
    OutputPart(const OutputPart&) = delete;
    OutputPart& operator=(const OutputPart&) = delete;
    ~OutputPart();

    void write(const void* bytes, std::size_t count);
    template <class T>
    void write(const T& value) {
        write(&value, sizeof value);
    }
    /// Flushes it to the disk.
    void finish();

private:
    void flush();

    std::string name_;
    int descriptor_ = -1;
    std::uint64_t offset_;
    std::string buffer_;
};

/// An empty file of a size, to be filled by OutputPart. \throw Error (Input)
void make_file(const std::string& name, std::uint64_t size);
/// Gives a file its name. \throw Error (Input)
void rename_file(const std::string& from, const std::string& to);

}  // namespace trisect::app
