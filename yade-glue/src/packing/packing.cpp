// SPDX-License-Identifier: GPL-3.0-or-later
#include "packing.hpp"

#include "particle/particle.hpp"

#include "registration/python_bytes.hpp"

#include <boost/python/errors.hpp>
#include <boost/python/extract.hpp>
#include <boost/python/tuple.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace py = boost::python;

namespace potential_particles {

namespace {

    // Python's lock is given back while the library works, and taken for each call.
    struct Receiver {
        const py::object& placed;
        PyThreadState* state = nullptr;
        bool raised = false;
    };

    py::tuple row(const pp_placement& body)
    {
        const double* p = body.pose.position;
        const double* q = body.pose.orientation;
        return py::make_tuple(body.shape, body.scale, py::make_tuple(p[0], p[1], p[2]),
                              py::make_tuple(q[0], q[1], q[2], q[3]));
    }

    // What Python raises stays set in its thread until packContainer throws it: no exception crosses the library.
    int32_t receive(void* context, const pp_placement* placements, std::size_t count) noexcept
    {
        auto& receiver = *static_cast<Receiver*>(context);
        PyEval_RestoreThread(receiver.state);
        bool goOn = false;
        try {
            py::list rows;
            for (std::size_t i = 0; i < count; ++i)
                rows.append(row(placements[i]));
            goOn = py::extract<bool>(receiver.placed(rows));
        } catch (const py::error_already_set&) {
            receiver.raised = true;
        } catch (...) {
            PyErr_SetString(PyExc_RuntimeError, "the bodies of a packing could not be handed over");
            receiver.raised = true;
        }
        receiver.state = PyEval_SaveThread();
        return goOn ? 0 : 1;
    }

    void corner(const py::dict& how, const char* name, double* to)
    {
        for (int axis = 0; axis < 3; ++axis)
            to[axis] = py::extract<double>(how[name][axis]);
    }

    pp_packing packingFrom(const py::dict& how)
    {
        pp_packing packing {};
        packing.container = field<std::uint32_t>(how, "container");
        packing.arrangement = field<std::uint32_t>(how, "arrangement");
        packing.shares = field<std::uint32_t>(how, "shares");
        packing.threads = field<std::uint32_t>(how, "threads");
        corner(how, "lower", packing.lower);
        corner(how, "upper", packing.upper);
        packing.margin = field<double>(how, "margin");
        packing.seed = field<std::uint64_t>(how, "seed");
        packing.number = field<std::uint64_t>(how, "number");
        return packing;
    }

} // namespace

py::dict packingChoices()
{
    py::dict choices;
    choices["box"] = PP_BOX;
    choices["cylinder"] = PP_CYLINDER;
    choices["scattered"] = PP_SCATTERED;
    choices["settled"] = PP_SETTLED;
    choices["number"] = PP_BY_NUMBER;
    choices["mass"] = PP_BY_MASS;
    choices["passing"] = PP_PASSING;
    return choices;
}

void packContainer(const py::list& shapes, const py::list& sizes, const py::dict& how, const py::object& placed)
{
    std::vector<std::shared_ptr<const Particle>> particles;
    std::vector<const pp_particle*> handles;
    for (py::ssize_t i = 0; i < py::len(shapes); ++i) {
        const py::extract<const yade::PotentialParticle&> shape(shapes[i]);
        particles.push_back(Particle::make(Definition::of(shape())));
        handles.push_back(particles.back()->require());
    }
    std::vector<double> rows;
    for (py::ssize_t i = 0; i < py::len(sizes); ++i)
        for (int j = 0; j < 2; ++j)
            rows.push_back(py::extract<double>(sizes[i][j]));
    const pp_packing packing = packingFrom(how);

    Receiver receiver { placed };
    char message[PP_MESSAGE_SIZE] = "";
    receiver.state = PyEval_SaveThread();
    const pp_status status = pp_pack(handles.data(), handles.size(), rows.data(), rows.size() / 2, &packing, &receive,
                                     &receiver, message, sizeof message);
    PyEval_RestoreThread(receiver.state);
    if (receiver.raised)
        py::throw_error_already_set();
    if (status != PP_OK)
        throw std::invalid_argument(message[0] ? message : pp_status_message(status));
}

} // namespace potential_particles
