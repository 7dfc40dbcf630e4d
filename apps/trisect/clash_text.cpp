// SPDX-License-Identifier: Apache-2.0
#include "clash_text.h"

namespace trisect::app {

ClashText clash_text(const Json& record) {
    ClashText out;
    out.a = record.at("a").get<std::string>();
    out.b = record.at("b").get<std::string>();
    out.set = record.value("set", std::string());
    out.is_answer = !record.contains("error");
    // No text of JSON has a line end within.
    for (const char c : record.dump(1, ' ', false, Json::error_handler_t::replace)) {
        out.text += c;
        if (c == '\n') out.text += "  ";
    }
    return out;
}

}  // namespace trisect::app
