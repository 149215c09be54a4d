// The header is C++ too: it compiles without a warning, and its functions have C linkage.
#include "potential_particles.h"

#include <cstdio>
#include <cstring>
#include <type_traits>

static_assert(std::is_same_v<pp_status, int32_t>);
static_assert(std::is_standard_layout_v<pp_contact> && std::is_trivial_v<pp_contact>);

int main() {
    pp_particle *sphere = nullptr;
    if (pp_particle_new(nullptr, 0, 0.0, 1.0, 1.0, &sphere, nullptr, 0) != PP_OK) return 1;
    pp_pose at_origin{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, beside{{1.5, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    pp_pair_state state{};
    pp_contact contact{};
    const bool found = pp_contact_detect(sphere, &at_origin, sphere, &beside, nullptr, &state, &contact) == PP_OK &&
                       contact.kind == PP_OVERLAPPING && contact.normal[0] > 0.999;
    pp_particle_free(sphere);
    const bool passed = found && std::strlen(pp_version()) > 0;
    std::printf("%d passed, %d failed\n", passed, !passed);
    return passed ? 0 : 1;
}
