/* What supple_tracy.h calls of Tracy, as its C interface has it. tracy_test.cpp has the functions: they note what they
 * are told. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct ___tracy_gpu_time_data {
    int64_t gpuTime;
    uint16_t queryId;
    uint8_t context;
};
struct ___tracy_gpu_zone_begin_data {
    uint64_t srcloc;
    uint16_t queryId;
    uint8_t context;
};
struct ___tracy_gpu_zone_end_data {
    uint16_t queryId;
    uint8_t context;
};
struct ___tracy_gpu_new_context_data {
    int64_t gpuTime;
    float period;
    uint8_t context;
    uint8_t flags;
    uint8_t type;
};
struct ___tracy_gpu_context_name_data {
    uint8_t context;
    const char* name;
    uint16_t len;
};
struct ___tracy_gpu_calibration_data {
    int64_t gpuTime;
    int64_t cpuDelta;
    uint8_t context;
};

uint64_t ___tracy_alloc_srcloc_name(uint32_t line, const char* source, size_t sourceSz, const char* function,
                                    size_t functionSz, const char* name, size_t nameSz, uint32_t color);
void ___tracy_emit_gpu_zone_begin_alloc_serial(const struct ___tracy_gpu_zone_begin_data);
void ___tracy_emit_gpu_zone_end_serial(const struct ___tracy_gpu_zone_end_data data);
void ___tracy_emit_gpu_time_serial(const struct ___tracy_gpu_time_data);
void ___tracy_emit_gpu_new_context_serial(const struct ___tracy_gpu_new_context_data);
void ___tracy_emit_gpu_context_name_serial(const struct ___tracy_gpu_context_name_data);
void ___tracy_emit_gpu_calibration_serial(const struct ___tracy_gpu_calibration_data);
int32_t ___tracy_connected(void);

#ifdef __cplusplus
}
#endif
