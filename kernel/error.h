// SPDX-License-Identifier: Apache-2.0
//
// Errors that leave the library.
// Each says what was wrong and where. None is thrown after a part of a result has been handed
// out.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace trisect {

/// What kind of failure an Error is. The values are the exit codes of the command.
enum class ErrorCode : std::uint8_t {
    Usage = 2,         ///< a call or command line that makes no sense
    Input = 3,         ///< unreadable or malformed file
    InvalidSolid = 4,  ///< well-formed data that does not bound a solid
    Limit = 5,         ///< a stated limit (memory, work, coordinate range) was hit
    Cancelled = 6,     ///< cancelled by the caller
    Unsupported = 7,   ///< a valid request that this version cannot carry out
    Internal = 70      ///< a broken promise of ours
};

/// Base of everything the library throws on purpose.
class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

/// A place in a text or binary file. `line` and `column` count from 1 and are 0 when unknown;
/// `offset` is a byte offset from the start of the file, used for binary formats.
struct FilePlace {
    std::string file;
    std::uint64_t line = 0;
    std::uint64_t column = 0;
    std::uint64_t offset = 0;

    /// "name:12:7" for text, "name: byte 84" for binary.
    [[nodiscard]] std::string to_string() const {
        if (line == 0) return file + ": byte " + std::to_string(offset);
        std::string s = file;
        s += ':';
        s += std::to_string(line);
        if (column != 0) {
            s += ':';
            s += std::to_string(column);
        }
        return s;
    }
};

/// The file could not be read or does not follow its format.
class InputError : public Error {
public:
    InputError(FilePlace place, const std::string& message)
        : Error(ErrorCode::Input, place.to_string() + ": " + message), place_(std::move(place)) {}
    [[nodiscard]] const FilePlace& place() const noexcept { return place_; }

private:
    FilePlace place_;
};

class LimitError : public Error {
public:
    explicit LimitError(const std::string& message) : Error(ErrorCode::Limit, message) {}
};

class CancelledError : public Error {
public:
    CancelledError() : Error(ErrorCode::Cancelled, "cancelled") {}
};

class UnsupportedError : public Error {
public:
    explicit UnsupportedError(const std::string& message)
        : Error(ErrorCode::Unsupported, message) {}
};

class UsageError : public Error {
public:
    explicit UsageError(const std::string& message) : Error(ErrorCode::Usage, message) {}
};

}  // namespace trisect
