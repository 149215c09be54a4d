// SPDX-License-Identifier: GPL-3.0-or-later
#include "builder.hpp"

#include "potential_particles.h"
#include "registration/python_bytes.hpp"

#include <boost/python/tuple.hpp>

#include <memory>
#include <stdexcept>
#include <vector>

namespace py = boost::python;

namespace potential_particles {

namespace {

    struct Free {
        void operator()(pp_particle* particle) const { pp_particle_free(particle); }
    };

    using Builder = decltype(&pp_particle_from_faces);

    py::tuple triple(const double (&v)[3]) { return py::make_tuple(v[0], v[1], v[2]); }

    template <std::size_t width> py::dict build(Builder builder, const py::object& given, double r, double k, double R)
    {
        struct Row {
            double of[width];
        };
        const auto rows = rowsOf<Row>(given);
        pp_particle* made = nullptr;
        pp_built built;
        char message[PP_MESSAGE_SIZE] = "";
        const pp_status status = builder(rows.empty() ? nullptr : rows[0].of, rows.size(), r, k, R, &made, &built, message, sizeof message);
        if (status != PP_OK)
            throw std::invalid_argument(message[0] ? message : pp_status_message(status));
        const std::unique_ptr<pp_particle, Free> particle(made);

        std::size_t count = 0;
        pp_particle_planes(made, nullptr, 0, &count);
        std::vector<double> planes(4 * count);
        pp_particle_planes(made, planes.data(), count, &count);
        py::list list;
        for (std::size_t i = 0; i < count; ++i)
            list.append(py::make_tuple(planes[4 * i], planes[4 * i + 1], planes[4 * i + 2], planes[4 * i + 3]));
        double rounding = 0, shadow = 0, bounding = 0;
        pp_particle_rounding_radius(made, &rounding);
        pp_particle_shadow_radius(made, &shadow);
        pp_particle_bounding_radius(made, &bounding);
        py::dict shape;
        shape["planes"] = py::tuple(list);
        shape["r"] = rounding;
        shape["k"] = k;
        shape["R"] = shadow;
        shape["volume"] = built.mass.volume;
        shape["error"] = built.mass.error;
        shape["inertia"] = py::make_tuple(built.mass.inertia[0], built.mass.inertia[1], built.mass.inertia[2]);
        shape["centroid"] = triple(built.centroid);
        const auto [w, x, y, z] = built.orientation;
        shape["orientation"] = py::make_tuple(w, x, y, z);
        shape["bounding_radius"] = bounding;
        return shape;
    }

} // namespace

py::dict shapeOfFaces(const py::object& planes, double r, double k, double R) { return build<4>(&pp_particle_from_faces, planes, r, k, R); }

py::dict shapeOfPoints(const py::object& points, double r, double k, double R) { return build<3>(&pp_particle_from_points, points, r, k, R); }

} // namespace potential_particles
