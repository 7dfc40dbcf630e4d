// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_arguments.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

void CsgArguments::fail(ErrorCode code, CsgPlace place, const std::string& message) const {
    throw CsgError(code, tree_.place(place), node_.name + ": " + message);
}

const CsgValue* CsgArguments::find(std::string_view name) const {
    // Of two with a name the last one counts.
    const auto& all = node_.arguments;
    const auto a = std::find_if(all.rbegin(), all.rend(),
                                [&](const CsgArgument& b) { return b.name == name; });
    return a == all.rend() || a->value.is_undefined() ? nullptr : &a->value;
}

double CsgArguments::number(const CsgValue& value) const {
    const double* n = value.number();
    if (n == nullptr) fail(ErrorCode::Input, value.place, "a number was expected");
    if (!std::isfinite(*n)) fail(ErrorCode::Input, value.place, "the number is not finite");
    return *n;
}

double CsgArguments::number(std::string_view name, double otherwise) const {
    const CsgValue* value = find(name);
    return value == nullptr ? otherwise : number(*value);
}

double CsgArguments::radius(std::string_view name, std::string_view diameter,
                            double otherwise) const {
    const CsgValue* value = find(diameter);
    return value == nullptr ? number(name, otherwise) : number(*value) / 2;
}

bool CsgArguments::truth(std::string_view name, bool otherwise) const {
    const CsgValue* value = find(name);
    if (value == nullptr) return otherwise;
    if (value->truth() == nullptr)
        fail(ErrorCode::Input, value->place, std::string(name) + " must be true or false");
    return *value->truth();
}

std::string CsgArguments::text(std::string_view name, std::string_view otherwise) const {
    const CsgValue* value = find(name);
    if (value == nullptr) return std::string(otherwise);
    if (value->text() == nullptr)
        fail(ErrorCode::Input, value->place, std::string(name) + " must be a text");
    return *value->text();
}

std::vector<bool> CsgArguments::truths(std::string_view name, std::size_t count) const {
    const CsgValue* value = find(name);
    if (value == nullptr) return std::vector<bool>(count, false);
    const auto one = [&](const CsgValue& v) {
        return v.truth() != nullptr ? *v.truth() : number(v) != 0;
    };
    if (value->list() == nullptr) return std::vector<bool>(count, one(*value));
    std::vector<bool> out;
    for (const CsgValue& v : *value->list()) out.push_back(one(v));
    out.resize(count, false);
    return out;
}

const CsgValue::List& CsgArguments::list(const CsgValue& value) const {
    if (value.list() == nullptr) fail(ErrorCode::Input, value.place, "a list was expected");
    return *value.list();
}

std::vector<double> CsgArguments::numbers(const CsgValue& value, std::size_t count) const {
    std::vector<double> out;
    for (const CsgValue& v : list(value)) out.push_back(number(v));
    if (out.size() < count)
        fail(ErrorCode::Input, value.place, std::to_string(count) + " numbers were expected");
    return out;
}

std::vector<double> CsgArguments::numbers(std::string_view name, std::size_t count,
                                          double otherwise) const {
    const CsgValue* value = find(name);
    if (value == nullptr) return std::vector<double>(count, otherwise);
    if (value->number() != nullptr) return std::vector<double>(count, number(*value));
    return numbers(*value, count);
}

std::vector<std::vector<std::uint32_t>> CsgArguments::index_lists(const CsgValue& value,
                                                                  std::size_t limit) const {
    std::vector<std::vector<std::uint32_t>> out;
    for (const CsgValue& entry : list(value)) {
        std::vector<std::uint32_t>& loop = out.emplace_back();
        for (const CsgValue& v : list(entry)) {
            const double i = number(v);
            if (i < 0 || i >= static_cast<double>(limit) || i != std::floor(i))
                fail(ErrorCode::Input, v.place, "no index of a point");
            loop.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return out;
}

}  // namespace trisect::detail
