// SPDX-License-Identifier: GPL-2.0-or-later
#include "shape.hpp"
#include "entered.hpp"
#include "mark.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace potential_particles {
namespace {

    // Of mass properties; a shape counts as centred and principal to the other.
    constexpr double massTolerance = 1e-9, centred = 1e-5;

    struct Place {
        const std::string& path;
        int line = 0;

        [[noreturn]] void refuse(const std::string& why) const
        {
            throw std::runtime_error(path + ":" + std::to_string(line) + ": " + why);
        }
    };

    std::string number(double value)
    {
        std::ostringstream out;
        out << value;
        return out.str();
    }

    Shape finished(const std::string& name, const std::vector<double>& planes, double r, double k, double shadowRadius,
                   const Place& place)
    {
        Shape shape;
        shape.name = name;
        pp_particle* made = nullptr;
        char why[PP_MESSAGE_SIZE];
        if (pp_particle_new(planes.data(), planes.size() / 4, r, k, shadowRadius, &made, why, sizeof why) != PP_OK)
            place.refuse("shape " + name + ": " + why);
        shape.particle.reset(made, pp_particle_free);
        pp_mass_properties mass;
        if (pp_particle_bounding_radius(made, &shape.radius) != PP_OK
            || pp_particle_mass_properties(made, massTolerance, &mass) != PP_OK)
            place.refuse("shape " + name + ": its mass properties cannot be computed: scale it to a size near 1");
        const Eigen::Vector3d centre(mass.centroid);
        if (centre.norm() > centred * shape.radius)
            place.refuse("shape " + name + ": its centre of mass is at " + number(centre[0]) + " " + number(centre[1])
                         + " " + number(centre[2])
                         + ": move its planes so that it is at the origin (potential_particles.to_lammps does)");
        const double* inertia = mass.inertia;
        const double most = std::max({ std::abs(inertia[3]), std::abs(inertia[4]), std::abs(inertia[5]) });
        if (most > centred * std::max({ inertia[0], inertia[1], inertia[2] }))
            place.refuse("shape " + name + ": its axes are not principal (product of inertia " + number(most)
                         + "): turn its planes into principal axes (potential_particles.to_lammps does)");
        shape.volume = mass.volume;
        shape.moments = Eigen::Vector3d(inertia);
        Mark mark;
        mark.add(planes.data(), planes.size());
        for (const double number : { r, k, shadowRadius })
            mark.add(&number, 1);
        shape.mark = mark.value();
        return shape;
    }

} // namespace

std::vector<Shape> readShapes(const std::string& text, const std::string& path)
{
    std::vector<Shape> shapes;
    std::istringstream lines(text);
    std::string line, name;
    std::vector<double> planes;
    double r = NAN, k = NAN, shadowRadius = NAN;
    bool inside = false;
    Place place { path };
    while (std::getline(lines, line)) {
        // The mark that some editors put before UTF-8.
        if (++place.line == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0)
            line.erase(0, 3);
        std::istringstream words(line.substr(0, line.find('#')));
        std::string keyword;
        if (!(words >> keyword))
            continue;
        const auto value = [&](const char* what) {
            std::string word;
            if (!(words >> word))
                place.refuse(std::string(what) + ": a number is missing");
            const double read = numberOf(word);
            if (std::isnan(read))
                place.refuse(std::string(what) + " = " + word + ": it must be a number");
            return read;
        };
        if (keyword == "shape") {
            if (inside)
                place.refuse("shape " + name + " has no end: write 'end' after its planes");
            if (!(words >> name))
                place.refuse("a shape has a name: write 'shape NAME'");
            for (const Shape& other : shapes)
                if (other.name == name)
                    place.refuse("shape " + name + " stands here twice: names differ");
            inside = true;
            planes.clear();
            r = k = shadowRadius = NAN;
        } else if (!inside)
            place.refuse("'" + keyword + "' outside a shape: begin with 'shape NAME'");
        else if (keyword == "r")
            r = value("r");
        else if (keyword == "k")
            k = value("k");
        else if (keyword == "R")
            shadowRadius = value("R");
        else if (keyword == "plane")
            for (const char* what : { "a", "b", "c", "d" })
                planes.push_back(value(what));
        else if (keyword == "end") {
            shapes.push_back(finished(name, planes, r, k, shadowRadius, place));
            inside = false;
        } else
            place.refuse("'" + keyword + "': it must be shape, r, k, R, plane or end");
        if (words >> keyword)
            place.refuse("'" + keyword + "' is one word too many");
    }
    if (inside)
        place.refuse("shape " + name + " has no end: write 'end' after its planes");
    if (shapes.empty())
        place.refuse("no shape in the file");
    return shapes;
}

} // namespace potential_particles
