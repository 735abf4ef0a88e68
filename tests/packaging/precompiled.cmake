# Given as CMAKE_PROJECT_supple_INCLUDE to builds that are thrown away: most of their time goes into reading the same
# headers again and again. Not for the build proper, where every file should say what it includes.
function(supple_precompile_all)
    foreach(floor supple_gpu supple_cage supple_skinning supple_surface supple_runtime)
        target_precompile_headers(${floor} PRIVATE
            <algorithm> <array> <cmath> <functional> <map> <memory> <string> <unordered_map> <utility> <variant> <vector>)
    endforeach()
    foreach(floor supple_cage supple_skinning supple_surface supple_runtime)
        target_precompile_headers(${floor} PRIVATE <glm/glm.hpp> <glm/gtc/quaternion.hpp>)
    endforeach()
    foreach(floor supple_gpu supple_skinning supple_surface supple_runtime)
        target_precompile_headers(${floor} PRIVATE <vulkan/vulkan_core.h>)
    endforeach()
    target_precompile_headers(supple_cage PRIVATE <nlohmann/json.hpp>)
endfunction()
cmake_language(DEFER CALL supple_precompile_all)
