// What lets one header be read by C++ and GLSL: the scalar names and the namespace brackets.
#ifndef SUPPLE_SHARED_PORTABLE_H
#define SUPPLE_SHARED_PORTABLE_H

#ifdef __cplusplus
#include <cstdint>
#define SUPPLE_SHARED_BEGIN                                                                                            \
    namespace supple::shared {                                                                                         \
    using uint = uint32_t;
#define SUPPLE_SHARED_END }
#define SUPPLE_SHARED_CONST inline constexpr uint
#else
#define SUPPLE_SHARED_BEGIN
#define SUPPLE_SHARED_END
#define SUPPLE_SHARED_CONST const uint
#endif

#endif
