// SPDX-License-Identifier: Apache-2.0

#include "solids.h"

#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/measure.h>

#include "arrays.h"
#include "run.h"

namespace trisect::python {

py::class_<Solid> solid_class(const py::module_& m) {
    return py::reinterpret_borrow<py::class_<Solid>>(m.attr("Solid"));
}

Solid import_solid(const PolygonMesh& mesh, const SolidOptions& options) {
    return run_on_threads([&](std::uint32_t threads) {
        SolidOptions own = options;
        own.import.threads = threads;
        try {
            return Solid::from_mesh(mesh, own);
        } catch (const LimitError&) {
            require_finite(mesh.points);  // the usual reason, and this names the place
            throw;
        }
    });
}

Solid import_solid(const py::object& vertices, const py::object& faces,
                   const SolidOptions& options) {
    const auto arrays = TriangleArrays::of(vertices, faces);
    if (!arrays) return import_solid(mesh_of(vertices, faces), options);
    const TriangleView view = arrays->view();
    try {
        return run_on_threads([&](std::uint32_t threads) {
            SolidOptions own = options;
            own.import.threads = threads;
            return Solid::from_triangles(view, own);
        });
    } catch (const UsageError&) {
        arrays->require_valid();
        throw;
    } catch (const LimitError&) {
        arrays->require_valid();
        throw;
    }
}

Solid evaluated(const Expression& formula, EvaluateOptions::Winding winding) {
    return run_on_threads([&](std::uint32_t threads) {
        EvaluateOptions options;
        options.threads = threads;
        options.winding = winding;
        return evaluate(formula, options);
    });
}

std::string exact_boundary_text(const Solid& solid) {
    return run([&] {
        if (solid.is_whole_space()) return exact_text(Brep());
        Brep brep = solid.to_brep();
        if (sign_of_volume(brep) < 0) brep = evaluate(~solid).to_brep();
        return exact_text(brep);
    });
}

std::string native_bytes_of(const Solid& solid) {
    return run_on_threads([&](std::uint32_t threads) {
        NativeWriteOptions options;
        options.threads = threads;
        return native_bytes(solid, options);
    });
}

Solid solid_of(const NativeFile& file) {
    return run_on_threads([&](std::uint32_t threads) {
        NativeReadOptions options;
        options.names = NativeNames::Fresh;
        options.threads = threads;
        return file.solid(options);
    });
}

}  // namespace trisect::python
