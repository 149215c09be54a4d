// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shape's attributes in Python.
#include "conic_potential_particle.hpp"
#include "plane_lists.hpp"
#include "particle/particle.hpp"
#include "registration/definitions.hpp"

namespace potential_particles {

using yade::Vector3r;

py::list ConicPotentialParticle::pyPlanes() const
{
    const Definition now = Definition::of(*this);
    if (!now.listsAgree())
        Particle::make(now)->require();
    py::list rows;
    for (std::size_t i = 0; i < now.a.size(); ++i)
        rows.append(py::make_tuple(now.a[i], now.b[i], now.c[i], now.d[i]));
    return rows;
}

void ConicPotentialParticle::pySetPlanes(const py::object& rows)
{
    Definition next = Definition::of(*this);
    for (auto* list : { &next.a, &next.b, &next.c, &next.d })
        list->clear();
    for (py::ssize_t i = 0; i < py::len(rows); ++i) {
        const py::object row = rows[i];
        if (py::len(row) != 4)
            throw std::invalid_argument("planes: row " + std::to_string(i) + " has " + std::to_string(py::len(row))
                                        + " numbers, not the four (a, b, c, d)");
        next.a.push_back(py::extract<double>(row[0]));
        next.b.push_back(py::extract<double>(row[1]));
        next.c.push_back(py::extract<double>(row[2]));
        next.d.push_back(py::extract<double>(row[3]));
    }
    give(next);
}

void ConicPotentialParticle::pySetAutomaticBox(bool automatic)
{
    automaticBox = automatic;
    settle();
}

namespace {
    constexpr double usualTolerance = 1e-6;

    pp_mass_properties massProperties(const pp_particle* particle, double tolerance = usualTolerance)
    {
        if (!(tolerance >= 1e-12 && tolerance <= 1))
            throw std::invalid_argument("tolerance=" + std::to_string(tolerance) + " must lie between 1e-12 and 1");
        pp_mass_properties properties;
        requireOk(pp_particle_mass_properties(particle, tolerance, &properties));
        return properties;
    }

    Eigen::Matrix3d matrix(const double (&numbers)[6])
    {
        const auto [xx, yy, zz, xy, yz, zx] = numbers;
        Eigen::Matrix3d inertia;
        inertia << xx, xy, zx, xy, yy, yz, zx, yz, zz;
        return inertia;
    }
}

py::tuple ConicPotentialParticle::pyMassProperties(double tolerance) const
{
    const pp_mass_properties properties = massProperties(require(), tolerance);
    return py::make_tuple(properties.volume, Vector3r(properties.centroid), matrix(properties.inertia),
                          properties.error);
}

double ConicPotentialParticle::pyVolume() const { return massProperties(require()).volume; }

Vector3r ConicPotentialParticle::pyCentroid() const { return Vector3r(massProperties(require()).centroid); }

Eigen::Matrix3d ConicPotentialParticle::pyInertia() const { return matrix(massProperties(require()).inertia); }

double ConicPotentialParticle::pyBoundingRadius() const
{
    double radius;
    requireOk(pp_particle_bounding_radius(require(), &radius));
    return radius;
}

double ConicPotentialParticle::pyPotential(const Vector3r& point) const
{
    double value;
    requireOk(pp_particle_potential(require(), &identity, point.data(), &value, nullptr));
    return value;
}

py::list ConicPotentialParticle::pySurfaceDistance(const py::object& directions) const
{
    const pp_particle* particle = require();
    py::list distances;
    for (py::ssize_t i = 0; i < py::len(directions); ++i) {
        const Vector3r direction = py::extract<Vector3r>(directions[i]);
        double distance;
        requireOk(pp_particle_surface_distance(particle, direction.data(), &distance));
        distances.append(distance);
    }
    return distances;
}

namespace {

    void set(yade::PotentialParticle& shape, std::vector<double> yade::PotentialParticle::*list,
             const std::vector<double>& values)
    {
        setList(shape, list, values);
    }

    void set(yade::PotentialParticle& shape, std::vector<Vector3r> yade::PotentialParticle::*,
             const std::vector<Vector3r>& values)
    {
        setVertices(shape, values);
    }

    template <class Value>
    void set(yade::PotentialParticle& shape, Value yade::PotentialParticle::*field, const Value& value)
    {
        shape.*field = value;
    }

    // A property of the base whose change makes the particle anew.
    template <class Value>
    void defining(PythonClass<ConicPotentialParticle, yade::PotentialParticle>& registered, const char* name,
                  Value yade::PotentialParticle::*field, const char* fieldDoc)
    {
        using Shape = ConicPotentialParticle;
        registered.add_property(name, py::make_getter(field, py::return_value_policy<py::return_by_value>()),
                                pythonFunction<void, Shape&, const Value&>([field](Shape& shape, const Value& value) {
                                    set(shape, field, value);
                                    shape.settle();
                                }),
                                fieldDoc);
    }

    // Reading: vectors by reference, as YADE does, so that shape.minAabb[0] = 1 works; lists by value.
    py::object reader(Vector3r yade::PotentialParticle::*field) { return py::make_getter(field); }

    template <class Value> py::object reader(Value yade::PotentialParticle::*field)
    {
        return py::make_getter(field, py::return_value_policy<py::return_by_value>());
    }

    // A property of the base that, once set, belongs to the user.
    template <class Value>
    void boxed(PythonClass<ConicPotentialParticle, yade::PotentialParticle>& registered, const char* name,
               Value yade::PotentialParticle::*field, const char* fieldDoc)
    {
        using Shape = ConicPotentialParticle;
        registered.add_property(name, reader(field),
                                pythonFunction<void, Shape&, const Value&>([field](Shape& shape, const Value& value) {
                                    set(shape, field, value);
                                    shape.automaticBox = false;
                                }),
                                fieldDoc);
    }

} // namespace

void ConicPotentialParticle::pyRegisterClass(py::object scope)
{
    checkPyClassRegistersItself(Entry<ConicPotentialParticle>::name);
    const py::scope inside(scope);
    const auto style = docstringStyle();
    using Base = yade::PotentialParticle;
    using Shape = ConicPotentialParticle;
    auto registered = registerClass<Shape, Base>();

    defining(registered, "a", &Base::a,
             "First component of each plane normal. See planes for setting all four lists at once.");
    defining(registered, "b", &Base::b, "Second component of each plane normal.");
    defining(registered, "c", &Base::c, "Third component of each plane normal.");
    defining(registered, "d", &Base::d, "Offset of each plane from the centre.");
    defining(registered, "r", &Base::r, "Rounding radius, length; > 0 unless k = 1.");
    defining(registered, "k", &Base::k, "Sphericity in [0, 1]: 0 rounded polyhedron, 1 sphere of radius R.");
    defining(registered, "R", &Base::R, "Radius of the shadow sphere, length; > 0 unless k = 0.");

    boxed(registered, "AabbMinMax", &Base::AabbMinMax,
          "Whether the box of the vertices is used, or a cube of half size R.");
    boxed(registered, "minAabb", &Base::minAabb, "Extent below the centre, positive, local axes; for display.");
    boxed(registered, "maxAabb", &Base::maxAabb, "Extent above the centre, local axes; for display.");
    boxed(registered, "minAabbRotated", &Base::minAabbRotated,
          "As minAabb, for contact detection when there are no vertices.");
    boxed(registered, "maxAabbRotated", &Base::maxAabbRotated,
          "As maxAabb, for contact detection when there are no vertices.");
    boxed(registered, "vertices", &Base::vertices, "Corners of a polyhedron that holds the particle, local axes.");

    registered
        .add_property("planes", &Shape::pyPlanes,
                      pythonFunction<void, Shape&, const py::object&>([](Shape& shape, const py::object& rows) {
                          shape.pySetPlanes(rows);
                          shape.settle();
                      }),
                      "All planes as a list of (a, b, c, d); sets the four lists at once.")
        .add_property(
            "automaticBox", +[](const Shape& shape) { return shape.automaticBox; }, &Shape::pySetAutomaticBox,
            "Whether the box attributes are computed. Turned off by setting one of them.")
        .def("massProperties", &Shape::pyMassProperties, py::arg("tolerance") = usualTolerance,
             "Volume, centroid, inertia matrix (as the attributes of these names), and an estimated bound on their "
             "relative error; "
             "tolerance: what this error should be, 1e-12 to 1.")
        .add_property("volume", &Shape::pyVolume, "Volume, by quadrature over the true surface, to 1e-6.")
        .add_property("centroid", &Shape::pyCentroid, "Centroid in local axes; YADE wants it at the origin.")
        .add_property("inertia", &Shape::pyInertia,
                      "Inertia matrix about the local origin for density 1; State.inertia wants principal axes.")
        .add_property("boundingRadius", &Shape::pyBoundingRadius,
                      "Radius of a ball about the centre that holds the particle.")
        .def("potential", &Shape::pyPotential, py::arg("point"),
             "f at a point in local axes: < 0 inside, 0 on the surface, > 0 outside.")
        .def("surfaceDistance", &Shape::pySurfaceDistance, py::arg("directions"),
             "Distance from the centre to the surface along each of a list of directions, local axes.");
}

} // namespace potential_particles
