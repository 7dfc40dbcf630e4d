// SPDX-License-Identifier: Apache-2.0
//
// Identities made of texts.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::app {

/// A name-based UUID of version 8 of some texts.
[[nodiscard]] std::string clash_id(std::initializer_list<std::string> texts);

/// Of a long text: made of those of its blocks, so that many may share the work.
inline constexpr std::size_t bytes_of_an_id_block = std::size_t{1} << 20;
[[nodiscard]] std::string long_text_id(std::string_view text);
[[nodiscard]] std::string long_text_id(const std::vector<std::string>& ids_of_blocks);

}  // namespace trisect::app
