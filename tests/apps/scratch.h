// SPDX-License-Identifier: Apache-2.0
//
// A folder of its own for each test, and small meshes as files in it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace trisect::test {

/// Test fixture; the folder is gone afterwards.
class Scratch : public testing::Test {
public:
    Scratch();
    ~Scratch() override;

protected:
    /// The path of a file of that name in the folder.
    [[nodiscard]] std::string path(std::string_view name) const;
    /// Writes the file and returns its path.
    [[nodiscard]] std::string write(std::string_view name, std::string_view bytes) const;
    [[nodiscard]] static std::string read(const std::string& path);
    [[nodiscard]] bool exists(std::string_view name) const;
    /// How many entries the folder has.
    [[nodiscard]] std::size_t entry_count() const;

    /// An axis-aligned box with six quadrilaterals.
    [[nodiscard]] std::string box(std::string_view name, std::array<int, 3> lower,
                                  std::array<int, 3> upper) const;
    /// The unit cube without its lid.
    [[nodiscard]] std::string open_box(std::string_view name) const;

private:
    std::filesystem::path folder_;
};

/// The OBJ text of an axis-aligned box; its corners get the numbers from `first` on.
[[nodiscard]] std::string box_text(std::array<int, 3> lower, std::array<int, 3> upper,
                                   int first = 1);

}  // namespace trisect::test
