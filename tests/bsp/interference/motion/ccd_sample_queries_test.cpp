// SPDX-License-Identifier: Apache-2.0
//
// Every query of the public collection is answered as its authors' exact computation answers it.

#include <gtest/gtest.h>

#include <cstddef>

#include "ccd_file.h"

namespace {

TEST(CcdSampleQueries, EveryAnswerAgreesWithTheGroundTruth) {
    const auto files = ccd::find_files();
    if (files.empty()) GTEST_SKIP() << "no folder ccd in $TRISECT_MODELS: nothing was compared";
    std::size_t queries = 0;
    for (const auto& path : files) {
        const ccd::File file = ccd::read_file(path);
        for (std::size_t i = 0; i < file.queries.size(); ++i, ++queries) {
            const auto s = ccd::first_contact(file, file.queries[i]);
            EXPECT_EQ(s.has_value(), file.queries[i].is_contact)
                << file.name << " query " << i << " at " << (s ? s->to_double() : -1);
        }
    }
    EXPECT_GE(queries, 1824U);
}

}  // namespace
