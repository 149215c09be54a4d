#include "answer.h"
#include "bodies.h"

const way ways[WAYS] = {
    {PP_MIDWAY, PP_FAST, "midway, fast"},
    {PP_MIDWAY, PP_CONE_PROGRAM, "midway, cone program"},
    {PP_CLOSEST, PP_FAST, "closest, fast"},
    {PP_CLOSEST, PP_CONE_PROGRAM, "closest, cone program"},
};

pp_settings settings_for(const way *chosen) {
    pp_settings settings = default_settings();
    settings.formulation = chosen->formulation;
    settings.back_end = chosen->back_end;
    settings.solve_separated = 1;
    return settings;
}
