// SPDX-License-Identifier: GPL-3.0-or-later
#include "rock.hpp"

#include "potential_particles.h"
#include "registration/python_bytes.hpp"

#include <boost/python/extract.hpp>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

namespace py = boost::python;

namespace potential_particles {

namespace {

    void require(pp_status status, const char* message)
    {
        if (status != PP_OK)
            throw std::invalid_argument(message[0] ? message : pp_status_message(status));
    }

    struct Point {
        double at[3];
    };

    std::vector<std::size_t> counts(const py::list& numbers)
    {
        std::vector<std::size_t> read;
        for (py::ssize_t i = 0; i < py::len(numbers); ++i)
            read.push_back(py::extract<std::size_t>(numbers[i]));
        return read;
    }

    struct Listener {
        const py::object& progress;
        bool raised = false;
    };

    // What Python raises stays set until sliceRock throws it: no exception crosses the library.
    int32_t tell(void* context, std::uint64_t joints, std::uint64_t blocks) noexcept
    {
        auto& listener = *static_cast<Listener*>(context);
        try {
            return py::extract<bool>(listener.progress(joints, blocks)) ? 0 : 1;
        } catch (const py::error_already_set&) {
        } catch (...) {
            PyErr_SetString(PyExc_RuntimeError, "the progress of slicing could not be told");
        }
        listener.raised = true;
        return 1;
    }

    struct Free {
        void operator()(pp_rock* rock) const { pp_rock_free(rock); }
    };

    template <class T, class Read>
    py::object all(Read read, const pp_rock& rock, std::uint64_t size, std::size_t width = 1)
    {
        std::vector<T> values(size * width);
        std::size_t count = 0;
        require(read(&rock, values.data(), size, &count), "");
        return bytes(values);
    }

} // namespace

py::object jointFromCorners(const py::object& corners)
{
    const auto given = rowsOf<Point>(corners);
    std::vector<pp_joint> made(1);
    char message[PP_MESSAGE_SIZE] = "";
    require(pp_joint_from_corners(given.empty() ? nullptr : given[0].at, given.size(), made.data(), message,
                                  sizeof message),
            message);
    return bytes(made);
}

py::object jointsOfSet(const py::dict& set, const py::object& centre, double reach)
{
    pp_joint_set given {};
    given.dip = field<double>(set, "dip");
    given.dip_direction = field<double>(set, "dip_direction");
    given.spacing = field<double>(set, "spacing");
    given.fisher = field<double>(set, "fisher");
    given.radius = field<double>(set, "radius");
    given.seed = field<std::uint64_t>(set, "seed");
    given.exponential = field<bool>(set, "exponential") ? 1 : 0;
    const double at[] = { py::extract<double>(centre[0]), py::extract<double>(centre[1]),
                          py::extract<double>(centre[2]) };
    std::vector<pp_joint> joints(1000);
    std::size_t count = 0;
    char message[PP_MESSAGE_SIZE] = "";
    pp_status status = PP_BUFFER_TOO_SMALL;
    while (status == PP_BUFFER_TOO_SMALL) {
        joints.resize(std::max(joints.size(), count));
        status = pp_joint_set_joints(&given, at, reach, joints.data(), joints.size(), &count, message, sizeof message);
    }
    require(status, message);
    joints.resize(count);
    return bytes(joints);
}

py::dict sliceRock(const py::object& domain, const py::object& joints, const py::object& outlines,
                   const py::list& outlineCounts, const py::object& regionPlanes, const py::list& regionCounts,
                   const py::dict& settings, const py::object& progress)
{
    using Plane = double[4];
    struct Row {
        Plane plane;
    };
    const auto outer = rowsOf<Row>(domain), regions = rowsOf<Row>(regionPlanes);
    const auto planes = rowsOf<pp_joint>(joints);
    const auto corners = rowsOf<Point>(outlines);
    const auto ofJoints = counts(outlineCounts), ofRegions = counts(regionCounts);
    pp_slice_settings limits {};
    limits.least_volume = field<double>(settings, "least_volume");
    limits.least_thickness = field<double>(settings, "least_thickness");
    limits.least_width = field<double>(settings, "least_width");
    limits.largest_aspect = field<double>(settings, "largest_aspect");
    limits.threads = field<std::uint64_t>(settings, "threads");
    limits.most_blocks = field<std::uint64_t>(settings, "most_blocks");

    Listener listener { progress };
    char message[PP_MESSAGE_SIZE] = "";
    pp_rock* made = nullptr;
    const pp_status status = pp_rock_new(outer.empty() ? nullptr : outer[0].plane, outer.size(), planes.data(),
                                         planes.size(), corners.empty() ? nullptr : corners[0].at, ofJoints.data(),
                                         regions.empty() ? nullptr : regions[0].plane, ofRegions.data(),
                                         ofRegions.size(), &limits, progress.is_none() ? nullptr : &tell, &listener,
                                         &made, message, sizeof message);
    const std::unique_ptr<pp_rock, Free> rock(made);
    if (listener.raised)
        py::throw_error_already_set();
    require(status, message);

    pp_rock_summary summary {};
    require(pp_rock_get_summary(rock.get(), &summary), "");
    py::dict read;
    read["blocks"] = all<pp_block>(&pp_rock_blocks, *rock, summary.blocks);
    read["faces"] = all<pp_block_face>(&pp_rock_faces, *rock, summary.faces);
    read["corners"] = all<double>(&pp_rock_corners, *rock, summary.corners, 3);
    read["partners"] = all<pp_face_partners>(&pp_rock_partners, *rock, summary.partners);
    read["missing"] = all<std::uint64_t>(&pp_rock_missing_joints, *rock, summary.missing);
    read["joints"] = summary.joints;
    read["too_small"] = summary.too_small;
    read["unclosed"] = summary.unclosed;
    return read;
}

} // namespace potential_particles
