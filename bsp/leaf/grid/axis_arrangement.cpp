// SPDX-License-Identifier: Apache-2.0
//
// Where everything is axis-perpendicular everything coincides: walls of rooms, teeth of combs,
// a thousand cubes with common faces. Comparing facets pair by pair then finds nothing but
// contacts, vertices lie on other surfaces, and every segment runs through an edge. But the planes
// cut the cell into at most 64³ units, each wholly inside or outside of every operand, because the
// boundary of an embedded operand turns only where two of these planes meet. So a facet is the
// centres of units in it; which units are inside follows from one that is known, the reference's,
// by crossing facets; the formula is evaluated word by word; and what bounds the result is where
// neighbouring units differ. The exact arithmetic that is left is one determinant of integers for
// the diagonal of a triangle.
//
// Rank compression and bitmaps are the usual way to the area of a union of rectangles (Bentley
// 1977, "Solutions to Klee's rectangle problems"), one dimension up.

#include <trisect/bsp/leaf/grid/axis_arrangement.h>

#include <algorithm>
#include <bit>
#include <tuple>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

// Words of all operands together.
constexpr std::size_t most_words = std::size_t{1} << 20;

template <class Number>
auto plane_polygons_key(const AxisPolygon<Number>& p) {
    return std::tuple(p.operand, p.plane.axis, p.plane.position);
}

template <class Number>
auto group_key(const AxisPolygon<Number>& p) {
    return std::tuple(p.ref.source->serial(), p.plane.sign);
}

// Calls visit(run) for the runs of equal keys.
template <class Polygon, class Key, class Visit>
void for_each_run(std::span<const Polygon> all, Key key, Visit visit) {
    for (std::size_t i = 0; i < all.size();) {
        std::size_t j = i + 1;
        while (j < all.size() && key(all[i]) == key(all[j])) ++j;
        visit(all.subspan(i, j - i));
        i = j;
    }
}

}  // namespace

template <class Number>
std::optional<LeafResult> AxisArrangement<Number>::try_to_arrange(const LeafProblem& problem,
                                                                  LeafFindings& findings) {
    problem_ = &problem;
    stats_ = &findings.stats;
    incomplete_.clear();
    if (!list() || !make_grid()) return std::nullopt;
    find_result();
    bench_.clear();
    if (occupancies_) emit_occupancy();
    if (!occupancies_) emit_all();
    findings.incomplete.insert(findings.incomplete.end(), incomplete_.begin(), incomplete_.end());
    findings.note_uncertain(problem);
    if (occupancies_ && any_cut_) return LeafPicture{make_occupancy()};
    return LeafPolygons{listed()};
}

// The units inside the result.
template <class Number>
void AxisArrangement<Number>::find_result() {
    const LeafProblem& problem = *problem_;
    check_budget(*problem.options, *stats_);
    insides_.assign(problem.operands.size() * words(), 0);
    for (std::size_t o = 0, i = 0; o < problem.operands.size(); ++o) {
        const auto operand = static_cast<LeafIndex>(o);
        std::size_t end = i;
        while (end < polygons_.size() && polygons_[end].operand == operand) ++end;
        fill(operand, Polygons(polygons_).subspan(i, end - i));
        i = end;
        const auto slot = static_cast<std::size_t>(problem.operands[o].slot);
        if (slot >= operand_of_slot_.size()) operand_of_slot_.resize(slot + 1);
        operand_of_slot_[slot] = operand;
    }
    known_.clear();
    remembers_ = problem.formula->is_large();
    evaluate(*problem.formula, result_);
    check_budget(*problem.options, *stats_);
}

// One look at both ends of a list: facets of one plane often stand together, so the first one says
// little about the last.
template <class Number>
bool AxisArrangement<Number>::seems_across_axes() const {
    Polygon p;
    return std::ranges::all_of(problem_->operands, [&](const LeafOperand& o) {
        return o.polygons.empty() || (p.read(o.polygons.front()) && p.read(o.polygons.back()));
    });
}

template <class Number>
bool AxisArrangement<Number>::list() {
    if (!seems_across_axes()) return false;
    polygons_.clear();
    parts_.clear();
    any_cut_ = needs_parts_ = false;
    occupancies_ = problem_->may_defer;
    const auto cell = AxisBox<Number>::of(problem_->cell);
    for (std::size_t o = 0; o < problem_->operands.size(); ++o) {
        const LeafOperand& operand = problem_->operands[o];
        if (!operand.embedded) return false;
        for (const PolygonRef& ref : operand.polygons) {
            Polygon p;
            if (!p.read(ref)) return false;
            const PolygonRef& first = operand.polygons[0];
            occupancies_ = occupancies_ && ref.fragment == nullptr && !ref.touched &&
                           ref.source == first.source && ref.flipped == first.flipped;
            if (!p.meets(cell)) continue;
            p.contained = true;
            for (std::size_t k = 0; k < 3; ++k)
                p.contained = p.contained && p.lo[k] >= cell.lo[k] && p.hi[k] <= cell.hi[k];
            p.operand = static_cast<LeafIndex>(o);
            polygons_.push_back(p);
        }
    }
    std::stable_sort(polygons_.begin(), polygons_.end(), [](const Polygon& a, const Polygon& b) {
        return std::tuple(plane_polygons_key(a), group_key(a)) <
               std::tuple(plane_polygons_key(b), group_key(b));
    });
    return true;
}

template <class Number>
bool AxisArrangement<Number>::make_grid() {
    for (std::size_t k = 0; k < 3; ++k) grid_.units(k).start();
    for (const Polygon& p : polygons_)
        grid_.units(p.plane.axis)
            .add({p.plane.position, PlaneName::support(p.ref.source, p.ref.facet), p.plane.sign});
    for (std::size_t k = 0; k < 3; ++k) {
        grid_.units(k).finish(k, problem_->cell);
        if (grid_.units(k).count() > axis_units_limit) return false;
    }
    return problem_->operands.size() * words() <= most_words;
}

// --- Which units are inside.

// From the reference along its row, from there to the rows of its layer, from those to all layers.
template <class Number>
void AxisArrangement<Number>::fill(LeafIndex operand, Polygons polygons) {
    std::uint64_t* units = units_of(operand);
    const auto at = [&](std::size_t k) { return Numbers::from_fine(problem_->reference.c[k]); };
    const std::size_t bit = grid_.units(0).unit_of(at(0));
    const std::size_t row = grid_.units(1).unit_of(at(1));
    const std::size_t layer = grid_.units(2).unit_of(at(2));
    const std::size_t n = rows();
    toggles_.assign(n * (layers() + 1), 0);
    UnitRows of_rows{};  // changes between rows of the reference's layer
    std::uint64_t line = 0;
    for (const Polygon& p : polygons) {
        const std::size_t axis = p.plane.axis;
        const std::size_t plane = grid_.units(axis).plane_at(p.plane.position);
        const UnitFrame frame = UnitFrame::of(axis);
        if (axis == 0) {
            if ((grid_.scan(p, frame, layer) >> row & 1) != 0)
                line ^= unit_bits(plane, grid_.units(0).count());
        } else if (axis == 1) {
            of_rows[plane] ^= grid_.scan(p, frame, layer);
        } else {
            const typename Grid::Reach reach = grid_.reach(p, frame);
            for (std::size_t r = reach.first_row; r < reach.end_row; ++r)
                toggles_[plane * n + r] ^= grid_.scan(p, frame, r);
        }
    }
    const bool inside = problem_->operands[as_index(operand)].winding > 0;
    if (((line >> bit & 1) != 0) != inside) line = ~line & all_bits();
    units[layer * n + row] = line;
    for (std::size_t r = row + 1; r < n; ++r)
        units[layer * n + r] = units[layer * n + r - 1] ^ of_rows[r];
    for (std::size_t r = row; r-- > 0;)
        units[layer * n + r] = units[layer * n + r + 1] ^ of_rows[r + 1];
    for (std::size_t w = (layer + 1) * n; w < words(); ++w) units[w] = units[w - n] ^ toggles_[w];
    for (std::size_t w = layer * n; w-- > 0;) units[w] = units[w + n] ^ toggles_[w + n];
}

template <class Number>
void AxisArrangement<Number>::evaluate(const Residual& formula, Units& out) {
    using Kind = Residual::Kind;
    if (const auto known = known_.find(&formula); remembers_ && known != known_.end()) {
        out = known->second;
        return;
    }
    const auto units_of_slot = [&](std::int32_t slot) {
        return units_of(operand_of_slot_[as_index(slot)]);
    };
    out.assign(words(), 0);
    const std::uint64_t all = all_bits();
    switch (formula.kind) {
        case Kind::Constant:
            if (formula.value) out.assign(words(), all);
            return;
        case Kind::Slot: {
            const std::uint64_t* units = units_of_slot(formula.slot);
            out.assign(units, units + words());
            return;
        }
        case Kind::Not:
            with_enough_stack([&] { evaluate(*formula.children[0], out); });
            for (std::uint64_t& w : out) w = ~w & all;
            break;
        case Kind::And:
        case Kind::Or:
        case Kind::Xor: {
            if (formula.kind == Kind::And) out.assign(words(), all);
            Units made;
            for (const Residual::Ref& c : formula.children) {
                const std::uint64_t* term = nullptr;
                if (c->kind == Kind::Slot) {
                    term = units_of_slot(c->slot);
                } else {
                    with_enough_stack([&] { evaluate(*c, made); });
                    term = made.data();
                }
                for (std::size_t w = 0; w < out.size(); ++w) {
                    if (formula.kind == Kind::And) {
                        out[w] &= term[w];
                    } else if (formula.kind == Kind::Or) {
                        out[w] |= term[w];
                    } else {
                        out[w] ^= term[w];
                    }
                }
            }
            break;
        }
    }
    if (remembers_) known_.emplace(&formula, out);
}

template <class Number>
auto AxisArrangement<Number>::sides(const std::uint64_t* units, std::size_t axis, std::size_t plane,
                                    std::size_t first_row, std::size_t end_row) const -> Sides {
    Sides s;  // NOLINT(*-member-init): other rows are not read
    const std::size_t n = rows();
    for (std::size_t r = first_row; r < end_row; ++r) {
        if (axis == 2) {
            s.low[r] = units[(plane - 1) * n + r];
            s.high[r] = units[plane * n + r];
        } else if (axis == 1) {
            s.low[r] = units[r * n + plane - 1];
            s.high[r] = units[r * n + plane];
        } else {
            s.low[r] = s.high[r] = 0;
            for (std::size_t b = 0; b < n; ++b) {
                const std::uint64_t pair = units[r * n + b] >> (plane - 1);
                s.low[r] |= (pair & 1) << b;
                s.high[r] |= (pair >> 1 & 1) << b;
            }
        }
    }
    return s;
}

// --- What bounds the result.

template <class Number>
void AxisArrangement<Number>::start_planes() {
    for (std::size_t k = 0; k < 3; ++k) {
        claimed_[k].assign(grid_.units(k).count() + 1, UnitRows{});
        found_[k].assign(occupancies_ ? grid_.units(k).count() + 1 : 0, 0);
    }
}

template <class Number>
void AxisArrangement<Number>::emit_all() {
    start_planes();
    for_each_run(Polygons(polygons_), plane_polygons_key<Number>,
                 [&](Polygons plane_polygons) { emit_plane(plane_polygons); });
}

// A plane is outlined as a whole where all of its facets have changed; any other needs the parts of
// its facets, and then an occupancy grid was made in vain.
template <class Number>
void AxisArrangement<Number>::emit_occupancy() {
    const std::uint64_t untouched = stats_->untouched_polygons;
    start_planes();
    for_each_run(Polygons(polygons_), plane_polygons_key<Number>, [&](Polygons plane_polygons) {
        if (!needs_parts_) emit_plane(plane_polygons);
    });
    if (!needs_parts_) return;
    occupancies_ = false;
    stats_->untouched_polygons = untouched;
    out_.clear();
    incomplete_.clear();
}

// All polygons of an operand in one plane.
template <class Number>
void AxisArrangement<Number>::emit_plane(Polygons plane_polygons) {
    start_plane(plane_polygons);
    std::uint64_t any = 0;
    for (std::size_t r = first_row_; r < end_row_; ++r) any |= up_[r] | down_[r];
    clean_.assign(plane_polygons.size(), 0);
    if (any != 0) {
        find_clean(plane_polygons);
    } else if (occupancies_) {
        for (const Polygon& p : plane_polygons) note_incomplete(p, overlapped(p), both_facings);
    }
    if (occupancies_) return;
    for_each_run(plane_polygons, group_key<Number>, [&](Polygons group) { emit_group(group); });
}

// Of a facet in the plane.
template <class Number>
void AxisArrangement<Number>::note_found(std::uint8_t what) {
    std::uint8_t& found = found_[axis_][plane_];
    found |= what;
    if (found == (found_clean | found_cut)) needs_parts_ = true;
}

template <class Number>
void AxisArrangement<Number>::start_plane(Polygons plane_polygons) {
    axis_ = plane_polygons[0].plane.axis;
    plane_ = grid_.units(axis_).plane_at(plane_polygons[0].plane.position);
    plane_polygons_ = plane_polygons;
    const UnitFrame frame = UnitFrame::of(axis_);
    first_row_ = axis_units_limit;
    end_row_ = 0;
    for (const Polygon& p : plane_polygons) {
        const typename Grid::Reach reach = grid_.reach(p, frame);
        first_row_ = std::min(first_row_, reach.first_row);
        end_row_ = std::max(end_row_, reach.end_row);
    }
    const Sides own =
        sides(units_of(plane_polygons[0].operand), axis_, plane_, first_row_, end_row_);
    const Sides whole = sides(result_.data(), axis_, plane_, first_row_, end_row_);
    UnitRows& claimed = claimed_[axis_][plane_];
    for (std::size_t r = first_row_; r < end_row_; ++r) {
        own_[r] = own.low[r] ^ own.high[r];
        bounds_[r] = whole.low[r] ^ whole.high[r];
        const std::uint64_t kept = own_[r] & bounds_[r] & ~claimed[r];
        claimed[r] |= kept;
        whole_low_[r] = whole.low[r];
        up_[r] = kept & whole.low[r];
        down_[r] = kept & whole.high[r];
    }
}

// The units of the operand's boundary of which a polygon has some area.
template <class Number>
UnitRows AxisArrangement<Number>::overlapped(const Polygon& p) const {
    const UnitFrame frame = UnitFrame::of(axis_);
    UnitRows rows{};
    for (std::size_t r = first_row_; r < end_row_; ++r)
        rows[r] = own_[r] & grid_.overlapped(p, frame, r);
    return rows;
}

// A polygon is clean if it stays as it is.
template <class Number>
void AxisArrangement<Number>::find_clean(Polygons plane_polygons) {
    for (std::size_t i = 0; i < plane_polygons.size(); ++i) {
        const UnitRows units = overlapped(plane_polygons[i]);
        if (is_clean(units)) {
            clean_[i] = 1;
            emit_clean(plane_polygons[i], units);
        } else if (occupancies_) {
            emit_uncut(plane_polygons[i], units);
        }
    }
}

template <class Number>
bool AxisArrangement<Number>::is_clean(const UnitRows& units) const {
    std::uint64_t up = 0;
    std::uint64_t down = 0;
    std::uint64_t lost = 0;
    for (std::size_t r = first_row_; r < end_row_; ++r) {
        up |= units[r] & up_[r];
        down |= units[r] & down_[r];
        lost |= units[r] & ~(up_[r] | down_[r]);
    }
    return lost == 0 && (up != 0) != (down != 0);
}

// What touches a facet must show in every cell unless it is whole there (see PolygonRef).
template <class Number>
void AxisArrangement<Number>::emit_clean(const Polygon& p, const UnitRows& units) {
    PolygonRef ref = p.ref;
    ref.touched = ref.touched || touches_others(p, units);
    if (!ref.touched) ++stats_->untouched_polygons;
    make_room(out_);
    if (occupancies_) {
        note_found(found_clean);
        needs_parts_ = needs_parts_ || ref.touched;
        parts_.push_back({false, corners_in(p, units)});
    } else if (ref.touched && !p.contained) {
        const auto part = clip_to_cell(bench_, ref, problem_->cell);
        if (!part) return;  // the box of a fragment may be too large
        ref = *part;
    }
    ref.flipped = is_inside_low(units) == (p.plane.sign < 0);
    out_.push_back(ref);
}

// Whether the result is inside on the lower side of some units of the plane.
template <class Number>
bool AxisArrangement<Number>::is_inside_low(const UnitRows& units) const {
    for (std::size_t r = first_row_; r < end_row_; ++r)
        if (units[r] != 0) return (whole_low_[r] & units[r]) != 0;
    return false;
}

// A facet of which something is left.
template <class Number>
void AxisArrangement<Number>::emit_uncut(const Polygon& p, const UnitRows& units) {
    Facings without = both_facings;
    for (const bool inside_low : {true, false}) {
        const UnitRows& all_kept = inside_low ? up_ : down_;
        UnitRows kept{};
        std::uint64_t any = 0;
        for (std::size_t r = first_row_; r < end_row_; ++r) any |= kept[r] = all_kept[r] & units[r];
        if (any == 0) continue;
        without[inside_low ? 1 : 0] = false;
        any_cut_ = true;
        note_found(found_cut);
        PolygonRef ref = p.ref;
        ref.touched = true;
        ref.flipped = inside_low == (p.plane.sign < 0);
        out_.push_back(ref);
        parts_.push_back({true, corners_in(p, kept)});
    }
    note_incomplete(p, units, without);
}

// The corners that the polygon's parts in some of its units have: convex parts have all that they
// reach.
template <class Number>
std::uint8_t AxisArrangement<Number>::corners_in(const Polygon& p, const UnitRows& units) const {
    const UnitFrame frame = UnitFrame::of(axis_);
    const auto units_at = [&](const LatticePoint& corner, std::size_t axis) {
        return grid_.units(axis).units_at(axis_position<Number>(corner[static_cast<int>(axis)]));
    };
    std::uint8_t out = 0;
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& corner = p.ref.source->corner(p.ref.facet, i);
        const std::uint64_t bits = units_at(corner, frame.bit_axis);
        for (std::uint64_t rows = units_at(corner, frame.row_axis); rows != 0; rows &= rows - 1)
            if ((units[static_cast<std::size_t>(std::countr_zero(rows))] & bits) != 0)
                out = static_cast<std::uint8_t>(out | 1U << i);
    }
    return out;
}

template <class Number>
std::unique_ptr<OccupancyGrid> AxisArrangement<Number>::make_occupancy() {
    auto out = std::make_unique<OccupancyGrid>();
    for (std::size_t k = 0; k < 3; ++k) {
        out->planes[k].reserve(grid_.units(k).count() + 1);
        for (std::size_t i = 0; i <= grid_.units(k).count(); ++i)
            out->planes[k].push_back(Numbers::to_wide(grid_.units(k).plane(i).at));
    }
    out->units = result_;
    out->parts = parts_;
    out->facets = PolygonList(listed());
    return out;
}

// What is left of the polygons of one source.
template <class Number>
void AxisArrangement<Number>::emit_group(Polygons group) {
    const std::size_t first_made = out_.size();
    for (const bool inside_low : {true, false}) {
        const UnitRows& kept = inside_low ? up_ : down_;
        std::uint64_t any = 0;
        for (std::size_t r = first_row_; r < end_row_; ++r) any |= kept[r];
        if (any != 0) emit_rectangles(group, kept, inside_low);
    }
    note_incomplete(group, first_made);
}

// Runs of bits that are the same from row to row.
template <class Number>
void AxisArrangement<Number>::emit_rectangles(Polygons group, UnitRows rows, bool inside_low) {
    for (std::size_t r = first_row_; r < end_row_; ++r) {
        while (rows[r] != 0) {
            const auto bit = static_cast<std::size_t>(std::countr_zero(rows[r]));
            const std::size_t end_bit =
                bit + static_cast<std::size_t>(std::countr_one(rows[r] >> bit));
            const std::uint64_t run = unit_bits(bit, end_bit);
            const std::uint64_t around =
                unit_bits(bit == 0 ? 0 : bit - 1, std::min(end_bit + 1, axis_units_limit));
            std::size_t end_row = r;
            for (; end_row < end_row_ && (rows[end_row] & around) == run; ++end_row)
                rows[end_row] &= ~run;
            const Rectangle rectangle{r, end_row, bit, end_bit};
            emit_clipped(group, rectangle, inside_low);
        }
    }
}

// Of planes of the grid.
template <class Number>
AxisRectangle<Number> AxisArrangement<Number>::with_names(const Rectangle& r) const {
    const UnitFrame frame = UnitFrame::of(axis_);
    AxisRectangle<Number> out;
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t axis = (axis_ + 1 + i) % 3;
        const bool is_row = axis == frame.row_axis;
        for (const bool is_low : {true, false}) {
            const std::size_t plane =
                is_low ? (is_row ? r.row : r.bit) : (is_row ? r.end_row : r.end_bit);
            const typename AxisUnits<Number>::Position& p = grid_.units(axis).plane(plane);
            out.sides[i][is_low ? 0 : 1] = {p.at, {p.name, is_low == (p.sign > 0)}};
        }
    }
    return out;
}

template <class Number>
AxisBox<Number> AxisArrangement<Number>::box_of(const Rectangle& r) const {
    const UnitFrame frame = UnitFrame::of(axis_);
    auto box = AxisBox<Number>::of(problem_->cell);
    const AxisUnits<Number>& rows = grid_.units(frame.row_axis);
    const AxisUnits<Number>& bits = grid_.units(frame.bit_axis);
    box.lo[frame.row_axis] = rows.plane(r.row).at;
    box.hi[frame.row_axis] = rows.plane(r.end_row).at;
    box.lo[frame.bit_axis] = bits.plane(r.bit).at;
    box.hi[frame.bit_axis] = bits.plane(r.end_bit).at;
    return box;
}

template <class Number>
std::optional<PolygonRef> AxisArrangement<Number>::clip_slowly(const Polygon& p,
                                                               const AxisRectangle<Number>& r) {
    WorkPolygon shape = bench_.polygon(p.ref);
    bench_.with_edges(shape, p.ref);
    for (const auto& sides : r.sides)
        for (const typename AxisRectangle<Number>::Side& s : sides)
            if (!shape.is_empty())
                shape = bench_.clipped(std::move(shape), bench_.plane(s.edge.plane),
                                       s.edge.above ? 1 : -1);
    if (shape.is_empty()) return std::nullopt;
    return make_fragment(bench_, p.ref, shape);
}

// What the polygons have of a rectangle.
template <class Number>
void AxisArrangement<Number>::emit_clipped(Polygons group, const Rectangle& r, bool inside_low) {
    const AxisBox<Number> box = box_of(r);
    std::optional<AxisRectangle<Number>> rectangle;  // most have no part of a polygon
    for (const Polygon& p : group) {
        if (clean_[static_cast<std::size_t>(&p - plane_polygons_.data())] != 0 || !p.meets(box))
            continue;
        make_room(out_);
        if (!rectangle) rectangle = with_names(r);
        std::optional<PolygonRef> part =
            p.slanted_count < 2 ? clip_to_rectangle(p, *rectangle) : clip_slowly(p, *rectangle);
        if (!part) continue;
        part->flipped = inside_low == (p.plane.sign < 0);
        out_.push_back(*part);
        ++stats_->pieces;
    }
}

// A facet that reaches into other cells must not pass for whole there when something else stands
// for it here.
template <class Number>
void AxisArrangement<Number>::note_incomplete(Polygons group, std::size_t first_made) {
    const auto made = std::span(out_).subspan(first_made);
    for (const Polygon& p : group) {
        if (clean_[static_cast<std::size_t>(&p - plane_polygons_.data())] != 0) continue;
        Facings without = both_facings;
        for (const PolygonRef& m : made)
            if (m.source == p.ref.source && m.facet == p.ref.facet)
                without[m.flipped == (p.plane.sign < 0) ? 1 : 0] = false;
        if (without[0] || without[1]) note_incomplete(p, overlapped(p), without);
    }
}

// A facet may bound a result with both facings, here with one and there with the other.
template <class Number>
void AxisArrangement<Number>::note_incomplete(const Polygon& p, const UnitRows& units,
                                              Facings without) {
    if (p.contained) return;
    std::uint64_t bounding = 0;
    for (std::size_t r = first_row_; r < end_row_; ++r) {
        const std::uint64_t here = bounds_[r] & units[r];
        if (without[1]) bounding |= here & whole_low_[r];
        if (without[0]) bounding |= here & ~whole_low_[r];
    }
    if (bounding != 0) incomplete_.push_back({p.ref.source->serial(), p.ref.facet});
}

// Whether the boundary of another operand may meet a polygon: it meets the closure of its units,
// and boxes do.
template <class Number>
bool AxisArrangement<Number>::touches_others(const Polygon& p, const UnitRows& rows) const {
    // Beside many operands it is not used: it only saves work in an assembly.
    constexpr std::size_t few = 8;
    if (problem_->operands.size() > few) return true;
    const UnitFrame frame = UnitFrame::of(axis_);
    const std::size_t row_count = grid_.units(frame.row_axis).count();
    const std::uint64_t all = unit_bits(0, grid_.units(frame.bit_axis).count());
    UnitRows wide{};
    for (std::size_t r = first_row_; r < end_row_; ++r) {
        const std::uint64_t bits = (rows[r] | rows[r] << 1 | rows[r] >> 1) & all;
        for (std::size_t near = r == 0 ? 0 : r - 1; near < std::min(r + 2, row_count); ++near)
            wide[near] |= bits;
    }
    const std::size_t first = first_row_ == 0 ? 0 : first_row_ - 1;
    const std::size_t end = std::min(end_row_ + 1, row_count);
    for (std::size_t o = 0; o < problem_->operands.size(); ++o) {
        if (static_cast<LeafIndex>(o) == p.operand) continue;
        const Sides s = sides(insides_.data() + o * words(), axis_, plane_, first, end);
        std::uint64_t inside = 0;
        std::uint64_t outside = 0;
        for (std::size_t r = first; r < end; ++r) {
            inside |= (s.low[r] | s.high[r]) & wide[r];
            outside |= ~(s.low[r] & s.high[r]) & wide[r];
        }
        if (inside != 0 && outside != 0)
            return std::ranges::any_of(polygons_, [&](const Polygon& q) {
                bool meets = q.operand != p.operand;
                for (std::size_t k = 0; meets && k < 3; ++k)
                    meets = p.lo[k] <= q.hi[k] && q.lo[k] <= p.hi[k];
                return meets;
            });
    }
    return false;
}

template class AxisArrangement<std::int64_t>;
template class AxisArrangement<Int128>;

}  // namespace trisect::detail
