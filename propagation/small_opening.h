#pragma once
// Openings in sheets as objects; what they and other objects are measured by.

#include <functional>
#include <vector>

#include "propagation/small_object.h"

namespace grimaldi {

/// The object of these triangles with centre, diameter and area.
SmallObject measured(ObjectKind kind, std::vector<ObjectFace> faces);

/// True if no triangle of the scene but those that `own` names has a bounding box within 1 cm of the object's.
bool stands_free(const Scene& scene, const SmallObject& object, const std::function<bool(std::uint32_t)>& own);

/// Adds the openings that find_small_objects tells of to `found`, whose `of_wedge` has all wedges of the scene.
void add_small_openings(const Scene& scene, double largest, SmallObjects& found);

}  // namespace grimaldi
