// SPDX-License-Identifier: Apache-2.0
//
// PlyScalars: the values of a PLY body, in any encoding.
// For bytes that were read before: places of errors are those of values.
#pragma once

#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/ply_header.h>
#include <trisect/brep/io/formats/text_cursor.h>

#include <cstdint>

namespace trisect::detail {

class PlyScalars {
public:
    PlyScalars(const InputText& source, const PlyHeader& header)
        : source_(source),
          text_(source, TextRules{}, header.body),
          here_(header.body),
          encoding_(header.encoding) {}

    void begin_entry() {
        if (encoding_ == PlyEncoding::Ascii) (void)text_.seek_word();
    }
    /// May be infinite or not a number where the type has such values.
    double next(PlyType type) {
        if (encoding_ == PlyEncoding::Ascii) {
            const double value = text_.any_real("a value");
            last_ = text_.last_number();
            return value;
        }
        return encoding_ == PlyEncoding::BinaryBigEndian ? take<true>(type) : take<false>(type);
    }
    /// The place of the last value.
    [[nodiscard]] const char* last() const noexcept { return last_; }

private:
    template <class T, bool Big>
    double loaded() {
        if (static_cast<std::size_t>(source_.end() - here_) < sizeof(T))
            source_.fail(source_.end(), "the file ends inside its data");
        last_ = here_;
        here_ += sizeof(T);
        return static_cast<double>(load<T, Big>(last_));
    }
    template <bool Big>
    double take(PlyType type) {
        switch (type) {
            case PlyType::Int8:
                return loaded<std::int8_t, Big>();
            case PlyType::UInt8:
                return loaded<std::uint8_t, Big>();
            case PlyType::Int16:
                return loaded<std::int16_t, Big>();
            case PlyType::UInt16:
                return loaded<std::uint16_t, Big>();
            case PlyType::Int32:
                return loaded<std::int32_t, Big>();
            case PlyType::UInt32:
                return loaded<std::uint32_t, Big>();
            case PlyType::Int64:
                return loaded<std::int64_t, Big>();
            case PlyType::UInt64:
                return loaded<std::uint64_t, Big>();
            case PlyType::Float32:
                return loaded<float, Big>();
            case PlyType::Float64:
                break;
        }
        return loaded<double, Big>();
    }

    const InputText& source_;
    TextCursor text_;
    const char* here_;
    const char* last_ = nullptr;
    PlyEncoding encoding_;
};

}  // namespace trisect::detail
