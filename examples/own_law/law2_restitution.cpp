// SPDX-License-Identifier: GPL-3.0-or-later
//
// Law2_ScGeom_FrictPhys_Restitution: springs with friction, as Cundall's and Strack's law, and a dashpot along the
// normal for a coefficient of restitution e. Of a mass m on the spring k_n
//
//     F_n = k_n overlap - c v_n,    c = 2 zeta sqrt(k_n m),    zeta = -ln e / sqrt(pi^2 + ln^2 e),
//
// v_n the speed at which the bodies part and m = m_1 m_2 / (m_1 + m_2), that of the one if the other is held.
#include "abi/body.hpp"
#include "abi/knksphys.hpp"
#include "abi/scene.hpp"
#include "abi/scgeom.hpp"
#include "registration/own_class.hpp"

PP_OWN_CLASS(Law2_ScGeom_FrictPhys_Restitution, LawFunctor, "ScGeom", "FrictPhys", 0,
             "Springs, friction and a dashpot along the normal for a coefficient of restitution.")

namespace potential_particles {

using yade::Vector3r;

class Law2_ScGeom_FrictPhys_Restitution final : public yade::LawFunctor {
public:
    ~Law2_ScGeom_FrictPhys_Restitution() override;
    PP_ABI_SERIALIZABLE_OVERRIDES
    PP_FUNCTOR_2D_TYPES

    // Runs in many threads at once: it changes the contact and adds forces, and nothing else. False ends the contact.
    bool go(boost::shared_ptr<yade::IGeom>& geometry, boost::shared_ptr<yade::IPhys>& physics,
            yade::Interaction* pair) override
    {
        auto& geom = static_cast<yade::ScGeom&>(*geometry);
        auto& phys = static_cast<yade::FrictPhys&>(*physics);
        if (geom.penetrationDepth < 0)
            return false;
        const yade::State &one = stateOf(pair->id1), &other = stateOf(pair->id2);
        // A cell that deforms moves its images, too: that is not taken into account here.
        const Vector3r shift = scene->isPeriodic ? Vector3r(scene->cell->hSize * pair->cellDist.cast<double>())
                                                 : Vector3r(Vector3r::Zero());
        const Vector3r arm1 = geom.contactPoint - one.se3.position,
                       arm2 = geom.contactPoint - other.se3.position - shift;
        const Vector3r velocity = other.vel + other.angVel.cross(arm2) - one.vel - one.angVel.cross(arm1);

        const double mass = one.mass > 0 && other.mass > 0 ? one.mass * other.mass / (one.mass + other.mass)
                                                           : std::max(one.mass, other.mass);
        const double loss = -std::log(restitution), zeta = loss / std::hypot(M_PI, loss);
        phys.normalForce
            = (phys.kn * geom.penetrationDepth - 2 * zeta * std::sqrt(phys.kn * mass) * velocity.dot(geom.normal))
            * geom.normal;
        Vector3r& shear = geom.rotate(phys.shearForce);
        shear -= phys.ks * geom.shearInc;
        const double most = phys.normalForce.norm() * phys.tangensOfFrictionAngle;
        if (shear.norm() > most)
            shear *= most / shear.norm();

        const Vector3r force = phys.normalForce + shear; // on body 2
        scene->forces().addForce(pair->id1, -force);
        scene->forces().addForce(pair->id2, force);
        scene->forces().addTorque(pair->id1, -arm1.cross(force));
        scene->forces().addTorque(pair->id2, arm2.cross(force));
        return true;
    }

    double restitution = 0.5;

    // Keywords in Python, and what is saved.
    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        visit("restitution", &Law2_ScGeom_FrictPhys_Restitution::restitution,
              "Speed after an impact over that before, (0, 1].");
    }

private:
    PP_ARCHIVED

    const yade::State& stateOf(int id) const { return *scene->bodies->body[static_cast<std::size_t>(id)]->state; }
};

using Law = Law2_ScGeom_FrictPhys_Restitution;
Law::~Law2_ScGeom_FrictPhys_Restitution() = default;
PP_FUNCTOR_2D_DEFINITIONS(Law2_ScGeom_FrictPhys_Restitution)
PP_ATTRIBUTE_DEFINITIONS(Law2_ScGeom_FrictPhys_Restitution, LawFunctor)

// After an attribute was set or a scene was loaded.
void Law::callPostLoad()
{
    if (!(restitution > 0 && restitution <= 1))
        throw std::invalid_argument("restitution = " + std::to_string(restitution) + " must lie in (0, 1]");
    yade::LawFunctor::callPostLoad();
}

} // namespace potential_particles

PP_OWN_MODULE(own_law, Law2_ScGeom_FrictPhys_Restitution)
