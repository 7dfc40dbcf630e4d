// SPDX-License-Identifier: Apache-2.0
//
// Reading DXF: the faces and meshes of model space, and blocks where they are inserted. A block is
// scaled, turned about z, then moved. Counts come before placing, as in the reader of AMF.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/models/dxf/blocks.h>
#include <trisect/brep/io/models/placement.h>
#include <trisect/brep/transform.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace trisect::detail {
namespace {

class DxfAssembly {
public:
    DxfAssembly(const InputText& source, DxfFile& file, ModelReport& report)
        : source_(source), file_(file), report_(report) {}

    Model assemble() {
        for (const auto& [name, block] : file_.blocks) (void)sum_of(block, source_.begin(), 0);
        const Sum all = sum_of(file_.entities, source_.begin(), 0);
        const ReadLimits& limits = source_.limits();
        if (all.vertices > limits.vertices || all.faces > limits.faces ||
            all.count > limits.instances)
            source_.fail_limit(source_.begin(),
                               "blocks amount to more than the limits for a file allow");
        if (all.faces == 0)
            throw UnsupportedError(source_.place(source_.begin()).to_string() +
                                   ": no 3DFACE and no mesh is in this DXF file");
        Model model;
        model.unit = file_.unit;
        place(file_.entities, {}, ExactAffine(), model);
        return model;
    }

private:
    /// What a block amounts to with all that is inserted in it.
    struct Sum {
        std::uint64_t vertices = 0;
        std::uint64_t faces = 0;
        std::uint64_t count = 0;
        std::uint64_t height = 0;
        bool is_open = true;
    };

    /// a + b · times, at most the largest number.
    static void add_up(std::uint64_t& sum, std::uint64_t more, std::uint64_t times = 1) {
        std::uint64_t product = 0;
        const bool is_large = __builtin_mul_overflow(more, times, &product);
        if (is_large || __builtin_add_overflow(sum, product, &sum)) sum = UINT64_MAX;
    }

    const DxfBlock& block_of(const DxfInsert& insert) const {
        const auto found = file_.blocks.find(insert.block);
        if (found == file_.blocks.end())
            source_.fail(insert.at, "there is no block " + shown_word(insert.block));
        return found->second;
    }

    Sum sum_of(const DxfBlock& block, const char* at, std::uint64_t depth) {
        check_stop();
        const auto [known, is_new] = sums_.try_emplace(&block);
        if (!is_new && known->second.is_open) source_.fail(at, "a block that contains itself");
        if (depth + known->second.height > source_.limits().nesting)
            source_.fail_limit(
                at, "blocks nest deeper than " + std::to_string(source_.limits().nesting));
        if (!is_new) return known->second;
        Sum sum;
        for (const ModelPart& part : block.parts) {
            add_up(sum.vertices, part.mesh.points.size());
            add_up(sum.faces, part.mesh.face_count());
            add_up(sum.count, 1);
        }
        for (const DxfInsert& i : block.inserts) {
            const Sum inner = sum_of(block_of(i), i.at, depth + 1);
            sum.height = std::max(sum.height, inner.height + 1);
            if (inner.faces == 0) continue;
            const std::uint64_t times = copies_of(i);
            add_up(sum.vertices, inner.vertices, times);
            add_up(sum.faces, inner.faces, times);
            add_up(sum.count, inner.count, times);
            add_up(sum.count, times);
        }
        sum.is_open = false;
        sums_[&block] = sum;
        return sum;
    }

    /// Of an insert with faces.
    std::uint64_t copies_of(const DxfInsert& i) const {
        const bool is_upright = i.extrusion[0] == 0 && i.extrusion[1] == 0 && i.extrusion[2] > 0;
        if (!is_upright)
            throw UnsupportedError(source_.place(i.at).to_string() +
                                   ": INSERT along another axis than z is not read");
        if (i.scale[0] == 0 || i.scale[1] == 0 || i.scale[2] == 0)
            source_.fail(i.at, "an INSERT that makes space flat");
        const double reach = std::fabs(static_cast<double>(i.columns) * i.column_spacing) +
                             std::fabs(static_cast<double>(i.rows) * i.row_spacing);
        if (!std::isfinite(reach))
            source_.fail_limit(i.at, "an INSERT beyond the range of doubles");
        const auto count = [&](std::int64_t n) {
            return n < 1 ? 1 : static_cast<std::uint64_t>(n);
        };
        std::uint64_t product = 0;
        if (__builtin_mul_overflow(count(i.columns), count(i.rows), &product)) return UINT64_MAX;
        return product;
    }

    static ExactAffine moved_by(const Point3d& v) {
        return ExactAffine::from_rows({1, 0, 0, v[0], 0, 1, 0, v[1], 0, 0, 1, v[2]});
    }

    static ExactAffine placement_of(const DxfInsert& i, const Point3d& base, double column,
                                    double row) {
        const AffineMap turn = AffineMap::rotation({0, 0, 1}, i.degrees);
        std::array<double, 12> rows{};
        for (std::size_t k = 0; k < 12; ++k) rows[k] = turn.rows[k / 4][k % 4];
        const Point3d& s = i.scale;
        // Columns and rows are along the turned axes, and not scaled.
        return moved_by({-base[0], -base[1], -base[2]})
            .then(ExactAffine::from_rows({s[0], 0, 0, 0, 0, s[1], 0, 0, 0, 0, s[2], 0}))
            .then(moved_by({column * i.column_spacing, row * i.row_spacing, 0}))
            .then(ExactAffine::from_rows(rows))
            .then(moved_by(i.at_point));
    }

    void place(const DxfBlock& block, const std::string& name, const ExactAffine& placement,
               Model& model) {
        check_stop();
        for (const ModelPart& own : block.parts) {
            ModelPart part;
            part.name = name.empty() ? own.name : name;
            add_placed(part, own.mesh, placement, report_);
            model.parts.push_back(std::move(part));
        }
        for (const DxfInsert& i : block.inserts) {
            const DxfBlock& inner = block_of(i);
            if (sums_.at(&inner).faces == 0) continue;
            for (std::int64_t row = 0; row < std::max<std::int64_t>(i.rows, 1); ++row)
                for (std::int64_t column = 0; column < std::max<std::int64_t>(i.columns, 1);
                     ++column)
                    place(inner, i.block,
                          placement_of(i, inner.base, static_cast<double>(column),
                                       static_cast<double>(row))
                              .then(placement),
                          model);
        }
    }

    const InputText& source_;
    DxfFile& file_;
    ModelReport& report_;
    std::map<const DxfBlock*, Sum> sums_;
};

}  // namespace

Model read_dxf_model(std::string_view data, const std::string& name, const ReadLimits& limits,
                     ModelReport& report) {
    if (data.starts_with("AutoCAD Binary DXF"))
        throw UnsupportedError(name + ": DXF is read as text, not in its binary form");
    const InputText source(data, name, limits, false);
    DxfFile file = read_dxf_blocks(source);
    return DxfAssembly(source, file, report).assemble();
}

}  // namespace trisect::detail
