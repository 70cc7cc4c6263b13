// Names in <contact>: which bodies and obstacles they mean, and what then holds between them (contact_table.h).
//
// Names of bodies and obstacles are told apart from each other and from the kinds of things of with=, so that
// one word means one thing. What is named has to be in contact with the body otherwise, by one of these kinds:
// a name says how, not whether.
#pragma once

#include "sim/body/body.h"
#include "sim/outside/world.h"

namespace rend {

// Fills the tables of all bodies with contact, and takes the floor from those that pass through it. UserError
// (BadInput), with its place: a name that nothing has, or that is no name; a pair that is named twice with
// different values; what is named and excluded, or not in contact at all.
void resolve_contact_names(const World& world, const std::vector<std::unique_ptr<Body>>& bodies);

// UserError: something bounces, where the scheme solves. What presses at the end of such a step is solved for,
// and there is no velocity with which it struck.
void refuse_restitution(const World& world, const std::vector<std::unique_ptr<Body>>& bodies,
                        const std::string& scheme);

// UserError: a body meets an obstacle that is a mesh, where the scheme solves: solved_contact.h knows planes,
// spheres and boxes.
void refuse_mesh_obstacles(const World& world, const std::vector<std::unique_ptr<Body>>& bodies,
                           const std::string& scheme);

} // namespace rend
