// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_frame.h>

#include <algorithm>
#include <vector>

namespace trisect::detail {

bool changes_axes(const AffineMap& map) {
    return std::all_of(map.rows.begin(), map.rows.end(), [](const auto& row) {
        return std::count_if(row.begin(), row.begin() + 3, [](double c) { return c != 0; }) == 1;
    });
}

AffineMap csg_matrix(const CsgArguments& arguments, bool flat) {
    const CsgValue* value = arguments.find("m");
    AffineMap map;
    if (value == nullptr) return map;
    const CsgValue::List& rows = arguments.list(*value);
    if (rows.size() < 3) arguments.fail(ErrorCode::Input, value->place, "a matrix was expected");
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<double> row = arguments.numbers(rows[k], 4);
        std::copy_n(row.begin(), 4, map.rows[k].begin());
    }
    if (rows.size() > 3 && arguments.numbers(rows[3], 4) != std::vector<double>{0, 0, 0, 1})
        arguments.fail(ErrorCode::Unsupported, rows[3].place, "the last row must be 0, 0, 0, 1");
    if (flat) {
        for (std::size_t k = 0; k < 2; ++k) map.rows[k][2] = 0;
        map.rows[2] = {0, 0, 1, 0};
    }
    return map;
}

}  // namespace trisect::detail
