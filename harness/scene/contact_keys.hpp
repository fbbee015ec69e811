// The scene keys of colliders.
#pragma once
#include <string_view>
#include <vector>

#include "harness/scene/scene_keys.hpp"

namespace pelage {

inline constexpr std::string_view contact_sphere_list = "contact.sphere";
inline constexpr std::string_view contact_capsule_list = "contact.capsule";

/// Returns the keys of `contact` except those of the lists. Key::slot points into `contact`.
std::vector<Key> contact_keys(ContactScene& contact);

/// Returns the keys of an entry of [[contact.sphere]], with short names.
std::vector<Key> contact_sphere_keys(ContactSphereScene& sphere);

/// Returns the keys of an entry of [[contact.capsule]], with short names.
std::vector<Key> contact_capsule_keys(ContactCapsuleScene& capsule);

}  // namespace pelage
