// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/native_file.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <trisect/brep/io/output_file.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/native/native_layout.h>
#include <trisect/bsp/native/native_mapping.h>
#include <trisect/bsp/native/native_names.h>
#include <trisect/bsp/native/native_reader.h>
#include <trisect/bsp/native/native_records.h>
#include <trisect/bsp/native/native_view.h>
#include <trisect/bsp/native/native_writer.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect {

namespace {

using detail::NativeHeader;
using detail::NativeSection;
using detail::NativeView;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Of whole coordinates positions are what they are; else one unit more on each side contains all
// that has a position in the box.
Bounds bounds_of(const NativeHeader& h) {
    Bounds out{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    if (h.box.is_empty()) return out;
    const Lattice lattice{h.exponent};
    const std::int64_t beyond = (h.flags & detail::NativeFlag::whole) != 0 ? 0 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool has_end = h.box.hi[k] < coordinate_limit && h.box.lo[k] > -coordinate_limit;
        out.lo[k] =
            has_end ? lattice.to_double(static_cast<double>(h.box.lo[k] - beyond)) : -infinity;
        out.hi[k] =
            has_end ? lattice.to_double(static_cast<double>(h.box.hi[k] + beyond)) : infinity;
    }
    return out;
}

Bounds bounds_of(const detail::Cell& cell, Lattice lattice) {
    Bounds out;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto outward = [&](std::int64_t position, double limit) {
            if (position <= -detail::universe_limit || position >= detail::universe_limit)
                return limit;
            const double c = lattice.to_double(detail::rounded_position(position));
            return std::nextafter(std::nextafter(c, limit), limit);
        };
        out.lo[k] = outward(cell.lo[k], -infinity);
        out.hi[k] = outward(cell.hi[k], infinity);
    }
    return out;
}

NativeInfo info_of(const NativeHeader& h) {
    NativeInfo out;
    out.version = h.version;
    out.lattice = Lattice{h.exponent};
    out.bounds = bounds_of(h);
    out.is_unbounded = h.far_out != 0;
    out.bytes = h.file_bytes();
    out.cells = h.count(NativeSection::Cells);
    out.polygons = h.polygons;
    out.fragments = h.count(NativeSection::Fragments);
    out.sources = h.count(NativeSection::Sources);
    out.triangles = h.count(NativeSection::Triangles);
    out.points = h.count(NativeSection::Points);
    out.depth = h.depth;
    return out;
}

// What one cell of a file lists.
class CellReader {
public:
    explicit CellReader(const NativeView& view)
        : view_(view), records_(detail::source_records(view)) {}

    [[nodiscard]] NativeCell read(std::uint64_t number) const {
        const detail::NativeLeafPlace at = detail::find_leaf(view_, number);
        const detail::CellRecord cell = detail::cell_record(view_, number);
        NativeCell out;
        out.bounds = bounds_of(at.cell, lattice());
        for (std::size_t k = 0; k < 3; ++k)
            out.reference[k] = lattice().to_double(detail::rounded_position(cell.reference.c[k]));
        out.winding = detail::node_record(view_, at.node).winding;
        out.complement = at.complemented;
        add_polygons(cell, out.polygons);
        return out;
    }

private:
    [[nodiscard]] Lattice lattice() const { return Lattice{view_.header().exponent}; }

    void add_polygons(const detail::CellRecord& cell, std::vector<NativePolygon>& out) const {
        if (cell.kind == detail::NativeList::AllFacets &&
            cell.count != records_[cell.source].facets())
            view_.fail(NativeSection::Cells, 0, "a cell without all facets");
        for (std::uint64_t i = 0; i < cell.count; ++i) {
            if (cell.kind == detail::NativeList::Polygons) {
                out.push_back(polygon(detail::polygon_record(view_, cell.first + i, records_)));
                continue;
            }
            std::uint32_t facet = static_cast<std::uint32_t>(i);
            if (cell.kind == detail::NativeList::WholeFacets)
                facet =
                    detail::NativeCursor(view_.records(NativeSection::Facets, cell.first + i, 1))
                        .next<std::uint32_t>();
            if (facet >= records_[cell.source].facets())
                view_.fail(NativeSection::Facets, cell.first + i, "a facet that is not there");
            out.push_back(polygon({cell.source, facet, 0, cell.flipped, false}));
        }
    }

    [[nodiscard]] NativePolygon polygon(const detail::PolygonRecord& p) const {
        const detail::SourceRecord& source = records_[p.source];
        NativePolygon out;
        out.flipped = p.flipped;
        out.whole = p.fragment == 0;
        out.source = name(source, p.facet);
        if (p.fragment != 0)
            add_fragment(p.fragment - 1, out.corners);
        else if (!source.has_planes)
            for (const std::uint32_t c : detail::triangle_record(view_, source, p.facet))
                out.corners.push_back(
                    in_users_units(detail::point_record(view_, source.points.first + c).doubles()));
        return out;
    }

    void add_fragment(std::uint32_t number, std::vector<Point3d>& corners) const {
        const detail::FragmentRecord f = detail::fragment_record(view_, number);
        for (std::uint32_t i = 0; i < f.count; ++i) {
            detail::NativeCursor from(view_.records(NativeSection::Edges, f.first + i, 1));
            from.skip(16);
            std::array<double, 3> c{};
            for (double& x : c) x = from.next<double>();
            corners.push_back(in_users_units(c));
        }
    }

    [[nodiscard]] FaceSource name(const detail::SourceRecord& source, std::uint32_t facet) const {
        std::uint32_t face = facet;
        if (source.faces.count != 0)
            face = detail::NativeCursor(
                       view_.records(NativeSection::Faces, source.faces.first + facet, 1))
                       .next<std::uint32_t>();
        if (source.names.count == 0) return {source.operand, face};
        if (face >= source.names.count)
            view_.fail(NativeSection::Names, source.names.first, "a face without a name");
        return detail::name_record(view_, source.names.first + face);
    }

    [[nodiscard]] Point3d in_users_units(const std::array<double, 3>& c) const {
        return {lattice().to_double(c[0]), lattice().to_double(c[1]), lattice().to_double(c[2])};
    }

    const NativeView& view_;
    std::vector<detail::SourceRecord> records_;
};

}  // namespace

struct NativeFile::Data {
    std::string owned;                         // of bytes in memory
    std::optional<detail::MappedFile> mapped;  // of a file
    std::optional<NativeView> view;
    NativeInfo info;

    void look(std::string_view bytes, const std::string& name) {
        view.emplace(bytes, name);
        info = info_of(view->header());
    }
};

std::string native_bytes(const Solid& solid, const NativeWriteOptions& options) {
    if (options.divided) solid.refine(options.threads);
    const auto state = detail::cut_state(solid);
    return detail::on_threads(options.threads, [&](std::uint32_t threads) {
        return detail::native_bytes_of(*state, options.divided, threads);
    });
}

void write_native(const Solid& solid, const std::filesystem::path& path,
                  const NativeWriteOptions& options) {
    write_file(path, native_bytes(solid, options), OutputSafety::Flushed);
}

NativeFile NativeFile::open(const std::filesystem::path& path) {
    auto data = std::make_shared<Data>();
    data->mapped.emplace(path);
    data->look(data->mapped->bytes(), path.string());
    return NativeFile(std::move(data));
}

NativeFile NativeFile::of_bytes(std::string bytes, const std::string& name) {
    auto data = std::make_shared<Data>();
    data->owned = std::move(bytes);
    data->look(data->owned, name);
    return NativeFile(std::move(data));
}

const NativeInfo& NativeFile::info() const { return data_->info; }

NativeCell NativeFile::cell(std::uint64_t number) const {
    if (number >= data_->info.cells)
        throw UsageError("the file has " + std::to_string(data_->info.cells) + " cells");
    return CellReader(*data_->view).read(number);
}

Solid NativeFile::solid(const NativeReadOptions& options) const {
    return detail::on_threads(options.threads, [&](std::uint32_t threads) {
        return detail::solid_of(detail::read_native_state(
            *data_->view, options.names == NativeNames::Fresh, options.depth, threads));
    });
}

Solid read_native(const std::filesystem::path& path, const NativeReadOptions& options) {
    return NativeFile::open(path).solid(options);
}

bool is_native(std::string_view bytes) noexcept { return bytes.starts_with(detail::native_magic); }

}  // namespace trisect
