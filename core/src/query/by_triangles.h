// The order of contacts.
#pragma once

#include "octoblisk/contact.h"

namespace octoblisk::detail {

/// The projection that sorts contacts by their triangles. Compilers inline it, unlike &Contact::triangles.
inline constexpr auto byTriangles = [](const Contact& contact) { return contact.triangles(); };

}  // namespace octoblisk::detail
