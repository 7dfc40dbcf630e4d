// SPDX-License-Identifier: Apache-2.0
//
// Booleans, transforms, parts and measures of solids.

#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/bsp/split.h>
#include <trisect/bsp/verify.h>

#include "call.h"
#include "handles.h"
#include "operation.h"

using namespace trisect;  // NOLINT(google-build-using-namespace)
using c::make_handle;
using c::required;

namespace {

Solid evaluated(const Expression& formula) {
    EvaluateOptions options;
    options.threads = c::limits_of_thread().threads;
    return evaluate(formula, options);
}

Expression boolean_of(trisect_operation operation, const trisect_solid* const* operands,
                      size_t count) {
    std::vector<Solid> solids;
    for (const trisect_solid* operand : c::array_of(operands, count, "operands"))
        solids.push_back(required(operand, "an operand").solid);
    if (solids.empty()) throw UsageError("operands: there is none");
    return expression_of(c::operation_of(operation), solids);
}

// Two handles, or none.
void write_both(trisect_solid** first, trisect_solid** second, Solid a, Solid b) {
    auto made = std::make_unique<trisect_solid>(trisect_solid{std::move(a)});
    *second = new trisect_solid{std::move(b)};
    *first = made.release();
}

template <class Cutter>
trisect_status split_by(const trisect_solid* solid, trisect_solid** first, trisect_solid** second,
                        const char* first_name, const char* second_name, const Cutter& cutter) {
    if (first != nullptr) *first = nullptr;
    if (second != nullptr) *second = nullptr;
    return c::call([&] {
        (void)required(first, first_name);
        (void)required(second, second_name);
        const Solid& s = required(solid, "solid").solid;
        EvaluateOptions options;
        options.threads = c::limits_of_thread().threads;
        SplitSolid parts = split(s, cutter(), options);
        write_both(first, second, std::move(parts.common), std::move(parts.rest));
    });
}

}  // namespace

trisect_status trisect_boolean(trisect_operation operation, const trisect_solid* const* operands,
                               size_t count, trisect_solid** result) {
    return make_handle(result, "result",
                       [&] { return evaluated(boolean_of(operation, operands, count)); });
}

trisect_status trisect_edited_new(trisect_edited** edited) {
    return make_handle(edited, "edited", [] {
        EvaluateOptions options;
        options.threads = c::limits_of_thread().threads;
        return EditedFormula(options);
    });
}

trisect_status trisect_edited_boolean(trisect_edited* edited, trisect_operation operation,
                                      const trisect_solid* const* operands, size_t count,
                                      int* evaluated_all, trisect_solid** result) {
    return make_handle(result, "result", [&] {
        ChangeReport change;
        Solid solid = required(edited, "edited")
                          .formula.evaluate(boolean_of(operation, operands, count), &change);
        if (evaluated_all != nullptr) *evaluated_all = change.evaluated_all ? 1 : 0;
        return solid;
    });
}

void trisect_edited_free(trisect_edited* edited) { delete edited; }

trisect_status trisect_complement(const trisect_solid* solid, trisect_solid** result) {
    return make_handle(result, "result",
                       [&] { return evaluated(~Expression(required(solid, "solid").solid)); });
}

trisect_status trisect_split_by_plane(const trisect_solid* solid, const double plane[4],
                                      trisect_solid** below, trisect_solid** above) {
    return split_by(solid, below, above, "below", "above", [&] {
        (void)required(plane, "plane");
        return Solid::half_space({plane[0], plane[1], plane[2], plane[3]});
    });
}

trisect_status trisect_split(const trisect_solid* solid, const trisect_solid* cutter,
                             trisect_solid** inside, trisect_solid** outside) {
    return split_by(solid, inside, outside, "inside", "outside",
                    [&]() -> const Solid& { return required(cutter, "cutter").solid; });
}

trisect_status trisect_solid_transform(const trisect_solid* solid, const double rows[12],
                                       double* largest_move, trisect_solid** result) {
    return make_handle(result, "result", [&] {
        (void)required(rows, "rows");
        AffineMap map;
        for (std::size_t i = 0; i < 12; ++i) map.rows[i / 4][i % 4] = rows[i];
        LatticeReport report;
        Solid moved = transformed(required(solid, "solid").solid, map, &report);
        if (largest_move != nullptr) *largest_move = report.max_move;
        return moved;
    });
}

trisect_status trisect_components(const trisect_solid* solid, trisect_solid_list** parts) {
    return make_handle(parts, "parts", [&] { return components(required(solid, "solid").solid); });
}

size_t trisect_solid_list_count(const trisect_solid_list* list) {
    return list != nullptr ? list->solids.size() : 0;
}

trisect_status trisect_solid_list_get(const trisect_solid_list* list, size_t index,
                                      trisect_solid** solid) {
    return make_handle(solid, "solid", [&] {
        const std::vector<Solid>& solids = required(list, "list").solids;
        if (index >= solids.size())
            throw UsageError("index: " + std::to_string(index) + " of " +
                             std::to_string(solids.size()));
        return solids[index];
    });
}

void trisect_solid_list_free(trisect_solid_list* list) { delete list; }

trisect_status trisect_solid_source_id(const trisect_solid* solid, uint32_t* id) {
    return c::call([&] { required(id, "id") = required(solid, "solid").solid.source_id(); });
}

trisect_status trisect_solid_is_empty(const trisect_solid* solid, int* is_empty) {
    return c::call([&] {
        required(is_empty, "is_empty") = required(solid, "solid").solid.is_empty() ? 1 : 0;
    });
}

trisect_status trisect_solid_is_whole_space(const trisect_solid* solid, int* is_whole_space) {
    return c::call([&] {
        required(is_whole_space, "is_whole_space") =
            required(solid, "solid").solid.is_whole_space() ? 1 : 0;
    });
}

trisect_status trisect_solid_equals(const trisect_solid* a, const trisect_solid* b, int* is_equal) {
    return c::call([&] {
        required(is_equal, "is_equal") =
            evaluated(required(a, "a").solid ^ required(b, "b").solid).is_empty() ? 1 : 0;
    });
}

trisect_status trisect_volume(const trisect_solid* solid, double* volume) {
    return c::call(
        [&] { required(volume, "volume") = trisect::volume(required(solid, "solid").solid); });
}

trisect_status trisect_area(const trisect_solid* solid, double* area) {
    return c::call(
        [&] { required(area, "area") = trisect::area(required(solid, "solid").solid).value; });
}

trisect_status trisect_exact_volume(const trisect_solid* solid, trisect_text** volume) {
    return make_handle(volume, "volume", [&] {
        return trisect::exact_volume(required(solid, "solid").solid).to_string();
    });
}

trisect_status trisect_centroid(const trisect_solid* solid, double centroid[3]) {
    return c::call([&] {
        (void)required(centroid, "centroid");
        const auto center = trisect::centroid(required(solid, "solid").solid);
        if (!center) throw UnsupportedError("the empty set has no centroid");
        for (std::size_t i = 0; i < 3; ++i) centroid[i] = (*center)[i];
    });
}

trisect_status trisect_bounds(const trisect_solid* solid, double low[3], double high[3]) {
    return c::call([&] {
        (void)required(low, "low");
        (void)required(high, "high");
        const auto box = trisect::bounds(required(solid, "solid").solid);
        if (!box) throw UnsupportedError("the empty set and all of space have no bounds");
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = box->lo[i];
            high[i] = box->hi[i];
        }
    });
}
