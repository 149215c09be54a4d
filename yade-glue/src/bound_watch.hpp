// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine that runs the collider when a body has left its box.
//
// YADE's collider need not run in each step when verletDist > 0: it widens boxes by a length and runs again when some
// centre has moved by it. A body that turns about its centre leaves its box unseen. This engine, before the collider in
// each step, makes the box of each potential particle as it stands and compares it with the one that the collider has.
//
// Why no pair is missed: the pairs whose boxes met when the collider ran last are all among the interactions, and stay
// there until it runs again. As long as each body lies in the box that it had then, bodies that touch have boxes that
// meet. Where one does not, or the periodic cell has changed, the collider runs in this step, before any contact is
// computed. Velocities do not enter, so nothing depends on how a body came to be where it is.
#pragma once

#include "../abi/archive.hpp"
#include "../abi/scene.hpp"

#include <boost/serialization/access.hpp>

namespace potential_particles {

class BoundWatch final : public yade::GlobalEngine {
public:
    ~BoundWatch() override;
    std::string getBaseClassName(unsigned int index = 0) const override;
    std::string getClassName() const override;
    void pyRegisterClass(boost::python::object scope) override;

    void action() override;

    // Whether one stands before the collider and has run in this step.
    static bool guards(const yade::Scene& scene);

private:
    friend class boost::serialization::access;
    template <class Archive> void serialize(Archive& archive, unsigned);

    bool cellHasChanged();
    bool someBodyIsOutside() const;

    // Of this run only: after a file is loaded the collider starts anew.
    long lastStep = -1;
    long requests = 0;
    yade::Cell::Matrix lastCell = yade::Cell::Matrix::Zero();
};

} // namespace potential_particles
