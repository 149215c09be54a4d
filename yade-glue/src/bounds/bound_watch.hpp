// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine that runs the collider when a body has left its box.
//
// YADE's collider need not run in each step when verletDist > 0: it widens boxes by a length and runs again when some
// centre has moved by it. A body that turns about its centre leaves its box unseen. This engine, before the collider in
// each step, makes the box of each potential particle, facet and box as it stands and compares it with the one that the
// collider has; or, which is faster, knows that it has moved and turned by less than it would take.
//
// Why no pair is missed: the pairs whose boxes met when the collider ran last are all among the interactions, and stay
// there until it runs again. As long as each body lies in the box that it had then, bodies that touch are such a pair.
// Where one does not, or the periodic cell has changed, the collider runs in this step, before any contact is computed.
// Velocities do not enter, so nothing depends on how a body came to be where it is.
#pragma once

#include "abi/archive.hpp"
#include "abi/bound.hpp"
#include "abi/scene.hpp"
#include "abi/state.hpp"

#include "particle/particle.hpp"
#include "registration/class_table.hpp"

namespace potential_particles {

class BoundWatch final : public yade::GlobalEngine {
public:
    ~BoundWatch() override;
    PP_CLASS_OVERRIDES

    void action() override;

    // Whether one stands before the collider and has run in this step.
    static bool guards(const yade::Scene& scene);

private:
    PP_ARCHIVED

    bool cellHasChanged();
    bool someBodyIsOutside();

    // How a body is looked at, by the class of its shape.
    enum class Kind : unsigned char { other, corners, conic, potential };
    static Kind kindOf(const yade::Shape& shape);

    // A particle with this serial number, posed so, lies in the box with `room` to spare on each side. That holds for
    // any body, so that changes of bodies, shapes or boxes need no notice.
    struct Inside {
        std::uint64_t serial = 0;
        const void* classOfShape = nullptr; // its virtual table
        Kind kind = Kind::other;
        yade::Vector3r position;
        yade::Quaternionr turn;
        yade::Vector3r min, max;
        double room;

        bool stillHolds(const Particle& particle, const yade::Se3r& at, const yade::Bound& bound) const;
        // The same for a body with corners, which has no particle: it stands where it stood.
        bool isUnmoved(const yade::Se3r& at, const yade::Bound& bound) const;
        void noteUnmoved(const yade::Se3r& at, const yade::Bound& bound);
        void note(const Particle& particle, const yade::Se3r& at, const yade::Bound& bound, double space);
    };
    bool isOutside(const yade::Body& body, Inside& known) const;
    bool cornersAreOutside(const yade::Body& body, Inside& known) const;

    // Of this run only: after a file is loaded the collider starts anew.
    long lastStep = -1;
    long requests = 0;
    yade::Cell::Matrix lastCell = yade::Cell::Matrix::Zero();
    std::vector<Inside> known; // one for each body
};

} // namespace potential_particles
