// SPDX-License-Identifier: Apache-2.0
//
// WrittenParts: parts in the text of a manifest, one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace trisect::app {

/// What is written of a part; empty where it is not.
struct WrittenPart {
    std::string file, name, id, group;
    std::array<double, 12> pose{};
    std::size_t numbers = 0;  ///< of the pose: 0, 3 or 12
};

/// Reads parts as most manifests have them, without a document of JSON, in a tenth of the time. It
/// takes nothing that is not JSON, and gives what a document would; what it does not take may be
/// JSON all the same (a member twice, one that is not known, a pose of four numbers), which another
/// reader is to say.
class WrittenParts {
public:
    /// \param text objects with commas between them, without brackets around; outlives this
    explicit WrittenParts(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

    /// The next part; false at the end, and where there is anything odd.
    bool next(WrittenPart& part);
    /// After next() was false: whether that was the end.
    [[nodiscard]] bool is_whole() const { return is_whole_; }

private:
    bool object(WrittenPart& part);
    bool member(WrittenPart& part);
    bool string(std::string& out);
    bool escape(std::string& out);
    bool code_unit(std::uint32_t& out);
    bool beyond_ascii(std::string& out);
    bool number(double& out);
    bool digits();
    bool pose(WrittenPart& part);
    template <typename Item>
    bool list(char end, const Item& item);
    bool word(std::string_view text);
    bool is_next(char c);
    void skip_space();

    const char* at_;
    const char* end_;
    std::string key_;
    unsigned seen_ = 0;  // members of this part, a bit each
    bool is_first_ = true;
    bool is_whole_ = false;
};

}  // namespace trisect::app
