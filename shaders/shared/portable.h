// What lets one header be read by C++ and GLSL: the scalar names, the namespace brackets, parameters.
#ifndef SUPPLE_SHARED_PORTABLE_H
#define SUPPLE_SHARED_PORTABLE_H

#ifdef __cplusplus
#include <cstdint>
#define SUPPLE_SHARED_BEGIN                                                                                            \
    namespace supple::shared {                                                                                         \
    using uint = uint32_t;
#define SUPPLE_SHARED_END }
#define SUPPLE_SHARED_CONST inline constexpr uint
#define SUPPLE_SHARED_FLOAT inline constexpr float
#define SUPPLE_SHARED_FUNCTION inline
#define SUPPLE_INOUT(T) T& // a parameter that the function changes
#define SUPPLE_SELECT(c, a, b) ((c) ? (a) : (b))
#else
#define SUPPLE_SHARED_BEGIN
#define SUPPLE_SHARED_END
#define SUPPLE_SHARED_CONST const uint
#define SUPPLE_SHARED_FLOAT const float
#define SUPPLE_SHARED_FUNCTION
#define SUPPLE_INOUT(T) inout T
#define SUPPLE_SELECT(c, a, b) mix(b, a, c) // without a branch: see select.glsl
#endif

#endif
