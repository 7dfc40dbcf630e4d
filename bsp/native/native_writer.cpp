// SPDX-License-Identifier: Apache-2.0
//
// All counts are found first; so every record is put where it belongs in one piece of memory, and
// parts of long sections are written by several threads.

#include <trisect/bsp/native/native_writer.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/io/formats/binary.h>
#include <trisect/bsp/native/checksum.h>
#include <trisect/bsp/native/native_box.h>
#include <trisect/bsp/native/native_layout.h>
#include <trisect/bsp/native/native_tree.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

// Numbers one after the other.
class Cursor {
public:
    explicit Cursor(char* at) : at_(at) {}
    template <class T>
    Cursor& operator<<(T value) {
        put<false>(at_, value);
        return *this;
    }
    Cursor& operator<<(const Box& box) {
        for (const std::int64_t c : box.lo) *this << c;
        for (const std::int64_t c : box.hi) *this << c;
        return *this;
    }
    Cursor& operator<<(const Plane::Coefficient& c) {
        for (int i = 0; i < 6; ++i) *this << c.limb(i);
        return *this;
    }
    void skip(std::size_t bytes) { at_ += bytes; }  // zeros are there

private:
    char* at_;
};

class Writer {
public:
    Writer(const SolidState& state, bool refined, std::uint32_t threads)
        : state_(state), threads_(threads), tree_(*state.root().node, refined) {
        count();
        out_.resize(header_.file_bytes());
    }

    std::string write() {
        write_sources();
        write_nodes();
        write_cells();
        write_fragments();
        write_incomplete();
        write_header();
        write_checksums();
        return std::move(out_);
    }

private:
    using Section = NativeSection;

    void count() {
        header_.exponent = state_.lattice.exponent;
        header_.far_out = state_.far_out;
        header_.depth = tree_.depth();
        set_flags();
        count_sources();
        header_.count(Section::Nodes) = tree_.nodes().size();
        header_.count(Section::Cells) = tree_.leaves().size();
        for (const CellNode* leaf : tree_.leaves()) count_list(leaf->polygons());
        header_.count(Section::Fragments) = tree_.fragments().size();
        for (const Fragment* f : tree_.fragments())
            header_.count(Section::Edges) += f->edges().size();
        incomplete_ = incomplete_facets();
        header_.count(Section::Incomplete) = incomplete_.size();
        // Imported: a solid of one cell.
        const CellNode& first = *tree_.nodes()[0].node;
        if (first.is_leaf() && first.size() != 0)
            header_.source = static_cast<std::uint32_t>(state_.source);
    }
    void set_flags() {
        const CellTree& tree = state_.tree();
        const auto set = [this](bool value, std::uint32_t flag) {
            if (value) header_.flags |= flag;
        };
        set(state_.embedded, NativeFlag::embedded);
        set(state_.whole, NativeFlag::whole);
        set(state_.lattice_matters, NativeFlag::lattice_matters);
        set(tree.root.complemented, NativeFlag::complemented);
        set(tree.may_have_straight_crossings, NativeFlag::straight_crossings);
        set(tree.has_usual_offsets, NativeFlag::usual_offsets);
    }
    void count_sources() {
        header_.count(Section::Sources) = tree_.sources().size();
        for (const Source* s : tree_.sources()) {
            header_.count(Section::Points) += s->mesh().points.size();
            header_.count(Section::Triangles) += s->mesh().triangles.size();
            header_.count(Section::Faces) += s->mesh().face_of_triangle.size();
            header_.count(Section::Planes) += planes_of(*s);
            header_.count(Section::Names) += s->names().size();
        }
    }
    static std::size_t planes_of(const Source& s) {
        return s.is_half_space() ? s.facet_count() : 0;
    }
    void count_list(const PolygonList& list) {
        header_.polygons += list.size();
        add_listed(header_.box, list);
        if (list.whole_source() == nullptr) header_.count(Section::Polygons) += list.size();
        if (!list.has_all_facets()) header_.count(Section::Facets) += list.facets().size();
    }
    // Of sources that are listed; others cannot be met.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> incomplete_facets() const {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
        for (const FacetName& n : state_.tree().incomplete) {
            const auto& sources = tree_.sources();
            const auto at = std::ranges::lower_bound(sources, n.serial, {}, &Source::serial);
            if (at != sources.end() && (*at)->serial() == n.serial)
                out.emplace_back(static_cast<std::uint32_t>(at - sources.begin()), n.facet);
        }
        return out;
    }

    [[nodiscard]] Cursor at(Section section, std::uint64_t record = 0) {
        const std::size_t bytes = native_record_bytes[static_cast<std::size_t>(section)];
        return Cursor(out_.data() + header_.offset(section) + record * bytes);
    }
    template <class T, class Put>
    void write_each(Section section, std::uint64_t first, std::span<const T> values,
                    const Put& put_one) {
        const ParallelParts parts(values.size(), threads_, std::size_t{1} << 16);
        parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            Cursor to = at(section, first + begin);
            for (std::size_t i = begin; i < end; ++i) put_one(to, values[i]);
        });
    }

    void write_sources() {
        std::array<std::uint64_t, native_sections> first{};
        Cursor to = at(Section::Sources);
        const Source* last = nullptr;
        for (const Source* s : tree_.sources()) {
            const bool same = last != nullptr && last->serial() == s->serial();
            last = s;
            to << static_cast<std::uint8_t>(s->is_half_space() ? 1 : 0)
               << static_cast<std::uint8_t>(same ? 1 : 0);
            for (const std::uint8_t a : s->axes()) to << a;
            to.skip(3);
            to << s->operand();
            to.skip(4);
            to << std::uint64_t{s->mesh().points.size()}
               << std::uint64_t{s->mesh().triangles.size()}
               << std::uint64_t{s->mesh().face_of_triangle.size()} << std::uint64_t{planes_of(*s)}
               << std::uint64_t{s->names().size()} << (s->is_half_space() ? s->box() : no_box);
            write_source(*s, first);
        }
    }
    void write_source(const Source& s, std::array<std::uint64_t, native_sections>& first) {
        const auto take = [&first](Section section, std::uint64_t n) {
            return std::exchange(first[static_cast<std::size_t>(section)],
                                 first[static_cast<std::size_t>(section)] + n);
        };
        const LatticeMesh& mesh = s.mesh();
        write_each<LatticePoint>(Section::Points, take(Section::Points, mesh.points.size()),
                                 mesh.points, [](Cursor& to, const LatticePoint& p) {
                                     to << p.x.to_double() << p.y.to_double() << p.z.to_double();
                                 });
        write_each<std::array<std::uint32_t, 3>>(
            Section::Triangles, take(Section::Triangles, mesh.triangles.size()), mesh.triangles,
            [](Cursor& to, const auto& t) { to << t[0] << t[1] << t[2]; });
        write_each<std::uint32_t>(
            Section::Faces, take(Section::Faces, mesh.face_of_triangle.size()),
            mesh.face_of_triangle, [](Cursor& to, std::uint32_t f) { to << f; });
        write_each<FaceSource>(Section::Names, take(Section::Names, s.names().size()), s.names(),
                               [](Cursor& to, const FaceSource& n) { to << n.operand << n.face; });
        Cursor to = at(Section::Planes, take(Section::Planes, planes_of(s)));
        for (std::uint32_t i = 0; i < planes_of(s); ++i) {
            const Plane p = s.support(i);
            to << p.normal(0) << p.normal(1) << p.normal(2) << p.offset();
        }
    }

    void write_nodes() {
        Cursor to = at(Section::Nodes);
        for (const NativeTree::Node& n : tree_.nodes()) {
            const CellNode& node = *n.node;
            unsigned flags = 0;
            if (node.is_leaf()) {
                if (node.is_mixed()) flags |= NativeNodeFlag::mixed;
            } else {
                if (node.child(0).complemented) flags |= NativeNodeFlag::below_complemented;
                if (node.child(1).complemented) flags |= NativeNodeFlag::above_complemented;
            }
            to << static_cast<std::uint8_t>(node.is_leaf() ? native_leaf_axis
                                                           : static_cast<unsigned>(node.axis()))
               << static_cast<std::uint8_t>(flags) << std::uint16_t{0}
               << std::int32_t{node.is_leaf() ? node.winding() : 0} << n.above
               << std::int64_t{node.is_leaf() ? 0 : node.splitter()} << n.leaf;
        }
    }

    void write_cells() {
        Cursor to = at(Section::Cells);
        Cursor facets = at(Section::Facets);
        Cursor polygons = at(Section::Polygons);
        std::uint64_t facet = 0;
        std::uint64_t polygon = 0;
        for (const CellNode* leaf : tree_.leaves()) {
            const PolygonList& list = leaf->polygons();
            for (const std::int64_t c : leaf->reference().c) to << c;
            const Source* const whole = list.whole_source();
            const bool by_number = whole != nullptr && !list.has_all_facets();
            const NativeList kind = list.empty()            ? NativeList::None
                                    : whole == nullptr      ? NativeList::Polygons
                                    : list.has_all_facets() ? NativeList::AllFacets
                                                            : NativeList::WholeFacets;
            const std::uint64_t first = kind == NativeList::Polygons      ? polygon
                                        : kind == NativeList::WholeFacets ? facet
                                                                          : 0;
            to << static_cast<std::uint32_t>(kind) << std::uint32_t{list.flipped() ? 1U : 0U}
               << std::uint32_t{whole != nullptr && !list.empty() ? tree_.number_of(whole) : 0}
               << std::uint32_t{0} << first << std::uint64_t{list.size()}
               << std::uint64_t{kind == NativeList::Polygons ? 0 : list.contained()};
            if (by_number) {
                for (const std::uint32_t f : list.facets()) facets << f;
                facet += list.size();
            } else if (whole == nullptr) {
                for (const PolygonRef& r : list) write_polygon(polygons, r);
                polygon += list.size();
            }
        }
    }
    void write_polygon(Cursor& to, const PolygonRef& r) const {
        const std::uint32_t flags = (r.flipped ? 1U : 0U) | (r.touched ? 2U : 0U);
        to << tree_.number_of(r.source) << r.facet
           << std::uint32_t{r.fragment != nullptr ? tree_.number_of(r.fragment) + 1 : 0} << flags;
    }

    void write_fragments() {
        Cursor to = at(Section::Fragments);
        Cursor edges = at(Section::Edges);
        std::uint64_t first = 0;
        for (const Fragment* f : tree_.fragments()) {
            const std::size_t n = f->edges().size();
            to << f->box() << first << static_cast<std::uint32_t>(n) << std::uint32_t{0};
            first += n;
            for (std::size_t i = 0; i < n; ++i) write_edge(edges, f->edges()[i], f->vertices()[i]);
        }
    }
    void write_edge(Cursor& to, const EdgeName& e, const Approximation& begin) const {
        const PlaneName& p = e.plane;
        to << std::int64_t{p.is_splitter() ? p.position()
                                           : std::int64_t{tree_.number_of(p.source())}}
           << p.facet << static_cast<std::uint8_t>(p.kind)
           << static_cast<std::uint8_t>(e.above ? 1 : 0) << std::uint16_t{0};
        for (const double c : begin.c) to << c;
        to << begin.error;
    }

    void write_incomplete() {
        Cursor to = at(Section::Incomplete);
        for (const auto& [source, facet] : incomplete_) to << source << facet;
    }

    void write_header() {
        std::copy(native_magic.begin(), native_magic.end(), out_.begin());
        Cursor to(out_.data() + native_place::version);
        to << header_.version << static_cast<std::uint32_t>(native_header_bytes)
           << header_.file_bytes() << header_.exponent << header_.flags << header_.far_out
           << header_.source << header_.box << header_.polygons << header_.depth;
        for (const std::uint64_t n : header_.counts) to << n;
        Cursor(out_.data() + native_place::checksum)
            << crc64(std::string_view(out_).substr(0, native_place::checksum));
    }

    void write_checksums() {
        const std::string_view all = std::string_view(out_).substr(0, header_.checksums());
        const std::size_t n = header_.blocks();
        char* const table = out_.data() + header_.checksums();
        const ParallelParts parts(n, threads_, 16);
        parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            Cursor to(table + 8 * begin);
            for (std::size_t i = begin; i < end; ++i)
                to << crc64(all.substr(i * native_block_bytes, native_block_bytes));
        });
        Cursor(table + 8 * n) << crc64({table, 8 * n});
    }

    const SolidState& state_;
    std::uint32_t threads_;
    NativeTree tree_;
    NativeHeader header_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> incomplete_;
    std::string out_;
};

}  // namespace

std::string native_bytes_of(const SolidState& state, bool refined, std::uint32_t threads) {
    return Writer(state, refined, threads).write();
}

}  // namespace trisect::detail
