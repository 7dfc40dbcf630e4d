// SPDX-License-Identifier: Apache-2.0
//
// Reading STEP (ISO 10303-21): solids and surface models of planar faces, of AP203, AP214 and
// AP242. Each is a part; assemblies are carried out. A file that no representation lists shapes in
// has those that it has anywhere. Counts come before placing, as in the reader of AMF.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/models/placement.h>
#include <trisect/brep/io/models/step/assembly.h>
#include <trisect/brep/io/models/step/shapes.h>
#include <trisect/brep/io/models/step/text.h>
#include <trisect/brep/io/models/step/units.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace trisect::detail {
namespace {

class StepReader {
public:
    StepReader(const InputText& source, ModelReport& report)
        : text_(source), report_(report), shapes_(text_, report) {}

    Model read() {
        frames_ = step_frames(text_);
        const bool has_shapes = std::any_of(frames_.begin(), frames_.end(),
                                            [](const StepFrame& f) { return !f.shapes.empty(); });
        if (!has_shapes) frames_ = {frame_of_all()};
        read_units();
        for (const StepFrame& f : frames_) read_shapes(f);
        count_all();
        Model model;
        model.unit = unit_;
        for (const StepFrame& f : frames_)
            if (!f.is_placed) place(f, ExactAffine(), model);
        return model;
    }

private:
    struct Solid {
        std::string name;
        PolygonMesh mesh;
    };
    /// What a frame amounts to with all that it places.
    struct Sum {
        std::uint64_t vertices = 0;
        std::uint64_t faces = 0;
        std::uint64_t count = 0;
        std::uint64_t height = 0;
        enum class State : std::uint8_t { New, Open, Done } state = State::New;
    };

    /// Of a file without representations of its shapes.
    StepFrame frame_of_all() {
        StepFrame out;
        for (std::size_t i = 0; i < text_.entity_count(); ++i) {
            const std::string_view keyword = text_.keyword(i);
            if (StepShapes::is_shape(keyword)) out.shapes.push_back(text_.id(i));
            if (keyword.starts_with("TESSELLATED_S") && out.shapes.empty())
                tessellated_ = text_.id(i);
        }
        const char* begin = text_.source().begin();
        if (out.shapes.empty() && tessellated_ != 0)
            text_.refuse(text_.entity(tessellated_, begin), "is not read; a B-rep is");
        if (out.shapes.empty())
            throw UnsupportedError(text_.source().place(begin).to_string() +
                                   ": no B-rep and no model of shells is in this STEP file");
        return out;
    }

    void read_units() {
        for (const StepFrame& f : frames_) {
            double& uncertainty = uncertainties_.emplace_back(0.0);
            for (const std::uint64_t id : f.contexts) {
                const StepEntity entity = text_.entity(id, text_.source().begin());
                const StepContext context = step_context(text_, entity);
                uncertainty = std::max(uncertainty, context.uncertainty);
                if (context.unit.empty()) continue;
                if (!unit_.empty() && unit_ != context.unit)
                    text_.refuse(entity, "has lengths in another unit (" + context.unit +
                                             ") than others of the file (" + unit_ +
                                             "); nothing is scaled");
                unit_ = context.unit;
            }
        }
    }

    void read_shapes(const StepFrame& frame) {
        const double uncertainty =
            uncertainties_[static_cast<std::size_t>(&frame - frames_.data())];
        for (const std::uint64_t id : frame.shapes) {
            check_stop();
            if (solids_.contains(id)) continue;
            const StepEntity shape = text_.entity(id, text_.source().begin());
            Solid made;
            const StepPart* item = shape.part("REPRESENTATION_ITEM");
            made.name = text_.name(item != nullptr ? *item : shape.parts.front(), 0);
            if (made.name == "NONE") made.name.clear();
            made.mesh = shapes_.read(shape, uncertainty);
            solids_.emplace(id, std::move(made));
        }
    }

    static void add_up(std::uint64_t& sum, std::uint64_t more) {
        sum = more > UINT64_MAX - sum ? UINT64_MAX : sum + more;
    }

    void count_all() {
        sums_.resize(frames_.size());
        Sum all;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            const char* begin = text_.source().begin();
            count_up(i, begin, 0);
            if (frames_[i].is_placed) continue;
            add_up(all.vertices, sums_[i].vertices);
            add_up(all.faces, sums_[i].faces);
            add_up(all.count, sums_[i].count);
        }
        const ReadLimits& limits = text_.source().limits();
        if (all.vertices > limits.vertices || all.faces > limits.faces ||
            all.count > limits.instances)
            text_.source().fail_limit(
                text_.source().begin(),
                "the assembly amounts to more than the limits for a file allow");
    }

    void count_up(std::size_t index, const char* at, std::uint64_t depth) {
        check_stop();
        Sum& sum = sums_[index];
        const InputText& source = text_.source();
        if (sum.state == Sum::State::Open) source.fail(at, "an assembly that contains itself");
        if (depth + sum.height > source.limits().nesting)
            source.fail_limit(
                at, "assemblies nest deeper than " + std::to_string(source.limits().nesting));
        if (sum.state == Sum::State::Done) return;
        sum.state = Sum::State::Open;
        for (const std::uint64_t id : frames_[index].shapes) {
            add_up(sum.vertices, solids_.at(id).mesh.points.size());
            add_up(sum.faces, solids_.at(id).mesh.face_count());
            add_up(sum.count, 1);
        }
        for (const StepFrame::Child& c : frames_[index].children) {
            count_up(c.frame, c.at, depth + 1);
            add_up(sum.vertices, sums_[c.frame].vertices);
            add_up(sum.faces, sums_[c.frame].faces);
            add_up(sum.count, sums_[c.frame].count);
            add_up(sum.count, 1);
            sum.height = std::max(sum.height, sums_[c.frame].height + 1);
        }
        sum.state = Sum::State::Done;
    }

    void place(const StepFrame& frame, const ExactAffine& placement, Model& model) {
        check_stop();
        for (const std::uint64_t id : frame.shapes) {
            const Solid& solid = solids_.at(id);
            ModelPart part;
            part.name = solid.name.empty() ? frame.name : solid.name;
            add_placed(part, solid.mesh, placement, report_);
            if (part.mesh.face_count() != 0) model.parts.push_back(std::move(part));
        }
        for (const StepFrame::Child& c : frame.children)
            place(frames_[c.frame], c.placement.then(placement), model);
    }

    StepText text_;
    ModelReport& report_;
    StepShapes shapes_;
    std::vector<StepFrame> frames_;
    std::vector<double> uncertainties_;
    std::vector<Sum> sums_;
    std::map<std::uint64_t, Solid> solids_;
    std::string unit_;
    std::uint64_t tessellated_ = 0;
};

}  // namespace

Model read_step(std::string_view data, const std::string& name, const ReadLimits& limits,
                ModelReport& report) {
    const InputText source(data, name, limits, false);
    return StepReader(source, report).read();
}

}  // namespace trisect::detail
