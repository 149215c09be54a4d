// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of an object that belongs to its YADE base class, for Boost archives.
//
// boost::serialization::base_object would need serialize() of the base, which YADE does not
// export. The serializers that YADE registered with Boost are found by type instead and called on
// the same object: the file looks exactly as with base_object.
#pragma once

#include <stdexcept>

#include <boost/archive/detail/archive_serializer_map.hpp>
#include <boost/archive/detail/basic_iserializer.hpp>
#include <boost/archive/detail/basic_oserializer.hpp>
#include <boost/archive/detail/basic_pointer_iserializer.hpp>
#include <boost/archive/detail/basic_pointer_oserializer.hpp>
#include <boost/serialization/access.hpp>
#include <boost/serialization/extended_type_info_typeid.hpp>
#include <boost/serialization/level.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/singleton.hpp>
#include <boost/serialization/split_member.hpp>
#include <boost/serialization/tracking.hpp>
#include <boost/serialization/void_cast.hpp>

namespace potential_particles {

template <class Base> class BasePart {
public:
    explicit BasePart(Base& object)
        : object(object)
    {
    }

    template <class Archive> void save(Archive& archive, unsigned) const
    {
        using Serializer = boost::archive::detail::basic_pointer_oserializer;
        archive.save_object(&object, registered<Archive, Serializer>().get_basic_serializer());
    }

    template <class Archive> void load(Archive& archive, unsigned)
    {
        using Serializer = boost::archive::detail::basic_pointer_iserializer;
        archive.load_object(&object, registered<Archive, Serializer>().get_basic_serializer());
    }

    BOOST_SERIALIZATION_SPLIT_MEMBER()

private:
    template <class Archive, class Serializer> static const Serializer& registered()
    {
        using namespace boost;
        const auto& type
            = serialization::singleton<serialization::extended_type_info_typeid<Base>>::get_const_instance();
        const auto* found = archive::detail::archive_serializer_map<Archive>::find(type);
        if (!found)
            throw std::logic_error(std::string("YADE registered no serializer for ") + typeid(Base).name());
        return *static_cast<const Serializer*>(found);
    }

    Base& object;
};

// Call first in serialize() of a class derived from a YADE class.
template <class Base, class Archive, class Derived>
void serializeBase(Archive& archive, Derived& object, const char* baseName)
{
    boost::serialization::void_cast_register<Derived, Base>(nullptr, nullptr);
    BasePart<Base> part(object);
    archive& boost::serialization::make_nvp(baseName, part);
}

} // namespace potential_particles

namespace boost {
namespace serialization {
    // No class name and no tracking of its own: the base's serializer writes those.
    template <class Base> struct implementation_level<potential_particles::BasePart<Base>> {
        using tag = mpl::integral_c_tag;
        using type = mpl::int_<object_serializable>;
        static constexpr int value = object_serializable;
    };
    template <class Base> struct tracking_level<potential_particles::BasePart<Base>> {
        using tag = mpl::integral_c_tag;
        using type = mpl::int_<track_never>;
        static constexpr int value = track_never;
    };
}
}

// In the private part of a class that archives have.
#define PP_ARCHIVED                                                                                                    \
    friend class boost::serialization::access;                                                                         \
    template <class Archive> void serialize(Archive& archive, unsigned);
