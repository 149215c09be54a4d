// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine that moves facets together as one rigid body: a lid, a plate, a wall that keeps a stress, a blade.
//
// It stands behind the contact loop and before NewtonIntegrator, which moves bodies whose degrees of freedom are
// blocked by the velocity that they have: that velocity is what this engine sets. It integrates as NewtonIntegrator
// does (leapfrog: velocities half a step after positions).
#pragma once

#include "abi/archive.hpp"
#include "abi/scene.hpp"

#include "registration/class_table.hpp"

namespace potential_particles {

class MovingMesh final : public yade::GlobalEngine {
public:
    ~MovingMesh() override;
    PP_CLASS_OVERRIDES
    int getBaseClassNumber() const override;
    void pySetAttr(const std::string& key, const boost::python::object& value) override;
    boost::python::dict pyDict() const override;
    void callPostLoad() override;

    void action() override;

    std::vector<int> ids;
    std::string free;
    double mass = 0, area = 0, damping = 0, greatestSpeed = 0;
    yade::Vector3r force = yade::Vector3r::Zero(), stress = yade::Vector3r::Zero();
    yade::Vector3r gravity = yade::Vector3r::Zero(), velocity = yade::Vector3r::Zero();
    yade::Vector3r angularVelocity = yade::Vector3r::Zero(), centre = yade::Vector3r::Zero();
    yade::Vector3r contactForce = yade::Vector3r::Zero(), contactTorque = yade::Vector3r::Zero();
    yade::Vector3r displacement = yade::Vector3r::Zero();
    double kineticEnergy = 0, contactWork = 0, appliedWork = 0, dissipated = 0;

    template <class Visit> static void eachAttribute(Visit&& visit)
    {
        visit("ids", &MovingMesh::ids, "Bodies that move together: facets, or others with all degrees blocked.");
        visit("free", &MovingMesh::free, "Axes along which forces move the mesh, of \"xyz\".");
        visit("mass", &MovingMesh::mass, "Mass of the mesh, where axes are free.");
        visit("force", &MovingMesh::force, "Force on the mesh from outside, beside stress and gravity.");
        visit("stress", &MovingMesh::stress, "Stress times area is a force on the mesh, too, along each axis.");
        visit("area", &MovingMesh::area, "On which stress acts, length^2.");
        visit("gravity", &MovingMesh::gravity, "Acceleration of its mass.");
        visit("velocity", &MovingMesh::velocity,
              "Prescribed along axes that are not free; along free ones what it has come to.");
        visit("angularVelocity", &MovingMesh::angularVelocity, "Prescribed turn about centre, rad/s.");
        visit("centre", &MovingMesh::centre, "About which it turns; it moves along.");
        visit("damping", &MovingMesh::damping, "As of NewtonIntegrator, along free axes.");
        visit("greatestSpeed", &MovingMesh::greatestSpeed, "Limit of the speed along free axes; 0: none.");
        visit("contactForce", &MovingMesh::contactForce, "Sum of the forces of contacts in the last step.");
        visit("contactTorque", &MovingMesh::contactTorque, "Their torque about centre.");
        visit("displacement", &MovingMesh::displacement, "Way of the mesh since it was made.");
        visit("kineticEnergy", &MovingMesh::kineticEnergy, "Of its motion along free axes.");
        visit("contactWork", &MovingMesh::contactWork, "Done by contacts on the mesh.");
        visit("appliedWork", &MovingMesh::appliedWork, "Done by force, stress and gravity along free axes.");
        visit("dissipated", &MovingMesh::dissipated, "Taken by damping and by the limit of the speed.");
    }

private:
    PP_ARCHIVED

    void sumContacts();
    void moveFreeAxes();
    void setVelocities();

    int placeOfEnergy = -1; // in YADE's energies
};

} // namespace potential_particles
