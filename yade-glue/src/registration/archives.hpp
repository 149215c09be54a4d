// SPDX-License-Identifier: GPL-3.0-or-later
//
// The four archives that YADE saves to and loads from. Boost exports a class for those archives
// that were included before BOOST_CLASS_EXPORT: include this first.
#pragma once

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>

#include <boost/serialization/export.hpp>
