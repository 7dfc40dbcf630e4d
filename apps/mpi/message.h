// SPDX-License-Identifier: Apache-2.0
//
// Messages between ranks, as bytes.
// All ranks run one program, so numbers are as in memory.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <trisect/kernel/error.h>

namespace trisect::app {

class MessageWriter {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
    void put_text(std::string_view text) {
        put(std::uint64_t{text.size()});
        bytes_ += text;
    }
    template <class T>
    void put_list(const std::vector<T>& list) {
        put(std::uint64_t{list.size()});
        bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
    }
    void put_texts(const std::vector<std::string>& texts) {
        put(std::uint64_t{texts.size()});
        for (const std::string& text : texts) put_text(text);
    }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }
    [[nodiscard]] std::string take() { return std::exchange(bytes_, {}); }

private:
    std::string bytes_;
};

class MessageReader {
public:
    explicit MessageReader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T>
    [[nodiscard]] T get() {
        T out{};
        std::memcpy(&out, next(sizeof out).data(), sizeof out);
        return out;
    }
    [[nodiscard]] std::string get_text() { return std::string(next(get<std::uint64_t>())); }
    template <class T>
    [[nodiscard]] std::vector<T> get_list() {
        const auto size = get<std::uint64_t>();
        const std::string_view bytes = next(size * sizeof(T));
        std::vector<T> out(size);
        if (size != 0) std::memcpy(out.data(), bytes.data(), bytes.size());
        return out;
    }
    [[nodiscard]] std::vector<std::string> get_texts() {
        std::vector<std::string> out(get<std::uint64_t>());
        for (std::string& text : out) text = get_text();
        return out;
    }

private:
    std::string_view next(std::uint64_t size) {
        if (rest_.size() < size) throw Error(ErrorCode::Internal, "a message that is too short");
        const std::string_view out = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return out;
    }

    std::string_view rest_;
};

}  // namespace trisect::app
