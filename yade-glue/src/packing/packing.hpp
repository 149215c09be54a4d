// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's packings for Python; the module potential_particles.packing says what the arguments are.
#pragma once

#include "abi/base.hpp"

#include <boost/python/dict.hpp>
#include <boost/python/list.hpp>

namespace potential_particles {

// The words that `how` of packContainer takes as "container", "arrangement" and "shares", with their numbers.
boost::python::dict packingChoices();

// Packs shapes (ConicPotentialParticle) in sizes (pairs of a size and a share). `how` holds the fields of pp_packing.
// `placed` is called now and then, with a list of bodies that have found their places, each (shape, scale, (x, y, z),
// (w, x, y, z)): the packing goes on when it returns true. What it raises ends the packing, too, and leaves this
// function.
void packContainer(const boost::python::list& shapes, const boost::python::list& sizes, const boost::python::dict& how,
                   const boost::python::object& placed);

} // namespace potential_particles
