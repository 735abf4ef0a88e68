/**
 * @file supple_tracy.h
 * Supple's passes as GPU zones of the profiler Tracy (https://github.com/wolfpld/tracy). C99 and C++. It is no part of
 * the library: a host includes it beside its own zones. Define TRACY_ENABLE, as all of a program does that Tracy looks
 * at, and let <tracy/TracyC.h> be found, of a version in which ___tracy_alloc_srcloc_name takes a color. Without
 * TRACY_ENABLE the functions do nothing and no Tracy is needed.
 *
 * Call suppleTracyBegin once suppleGetTimingOrigin has a result, suppleTracyCollect in every frame after
 * suppleBeginFrame, and suppleTracyCalibrate every second or so, because the clocks of CPU and device drift apart.
 * deviceNow is in nanoseconds, as SuppleTiming.gpuBegin counts them. hostNow is in nanoseconds of any steady clock of
 * the CPU. Read both together, by VK_EXT_calibrated_timestamps: docs/profiling.md has the lines.
 */
#ifndef SUPPLE_TRACY_H
#define SUPPLE_TRACY_H

#include "supple.h"

#include <stdio.h>
#include <string.h>

#ifdef TRACY_ENABLE
#include <tracy/TracyC.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Entries of suppleGetTimings that are taken of a frame; further ones are left out. */
#define SUPPLE_TRACY_MOST_TIMINGS 512u

/** What has been told to Tracy. All zero at first. */
typedef struct SuppleTracy {
    int hasBegun;                                    /**< suppleTracyBegin was called */
    uint8_t id;                                      /**< of the GPU context in Tracy */
    uint16_t query;                                  /**< number of the next timestamp; Tracy lets them wrap round */
    uint64_t frame;                                  /**< whose passes were collected last */
    double hostNow;                                  /**< of the last calibration */
    SuppleTiming timings[SUPPLE_TRACY_MOST_TIMINGS]; /**< of that frame */
} SuppleTracy;

/** Adds a GPU context to Tracy's timeline. id is its number there. Contexts that Tracy makes itself count from 0, so
 * take one that is far from these. */
static inline void suppleTracyBegin(SuppleTracy* tracy, uint8_t id, const char* name, double deviceNow, double hostNow);
/** Tells Tracy how the two clocks lie to each other now. */
static inline void suppleTracyCalibrate(SuppleTracy* tracy, double deviceNow, double hostNow);
/** Makes zones of the passes of the newest completed frame, once. Each says its group and surface. */
static inline void suppleTracyCollect(SuppleTracy* tracy, SuppleContext context);

#ifdef TRACY_ENABLE

static inline void suppleTracyBegin(SuppleTracy* tracy, uint8_t id, const char* name, double deviceNow,
                                    double hostNow) {
    struct ___tracy_gpu_new_context_data context;
    struct ___tracy_gpu_context_name_data named;
    memset(&context, 0, sizeof context);
    context.gpuTime = (int64_t)deviceNow;
    context.period = 1.0f; /* nanoseconds */
    context.context = id;
    context.flags = 1; /* it is calibrated */
    context.type = 2;  /* Vulkan */
    ___tracy_emit_gpu_new_context_serial(context);
    memset(&named, 0, sizeof named);
    named.context = id;
    named.name = name;
    named.len = (uint16_t)strlen(name);
    ___tracy_emit_gpu_context_name_serial(named);
    tracy->id = id;
    tracy->hostNow = hostNow;
    tracy->hasBegun = 1;
}

static inline void suppleTracyCalibrate(SuppleTracy* tracy, double deviceNow, double hostNow) {
    struct ___tracy_gpu_calibration_data data;
    if (!tracy->hasBegun || hostNow <= tracy->hostNow) {
        return;
    }
    memset(&data, 0, sizeof data);
    data.gpuTime = (int64_t)deviceNow;
    data.cpuDelta = (int64_t)(hostNow - tracy->hostNow);
    data.context = tracy->id;
    ___tracy_emit_gpu_calibration_serial(data);
    tracy->hostNow = hostNow;
}

/* One pass. Tracy is told when it began and ended, after the fact. */
static inline void suppleTracyZone(SuppleTracy* tracy, const SuppleTiming* timing) {
    char where[64];
    struct ___tracy_gpu_zone_begin_data begin;
    struct ___tracy_gpu_zone_end_data end;
    struct ___tracy_gpu_time_data time;
    const char* name = suppleGetPassName(timing->pass);
    int length = timing->surface == SUPPLE_NO_SURFACE
                     ? snprintf(where, sizeof where, "group %llu", (unsigned long long)timing->group.id)
                     : snprintf(where, sizeof where, "group %llu, surface %u", (unsigned long long)timing->group.id,
                                (unsigned)timing->surface);
    memset(&begin, 0, sizeof begin);
    memset(&end, 0, sizeof end);
    memset(&time, 0, sizeof time);
    begin.srcloc = ___tracy_alloc_srcloc_name(0, "supple", 6, where, (size_t)length, name, strlen(name), 0);
    begin.queryId = tracy->query++;
    begin.context = tracy->id;
    ___tracy_emit_gpu_zone_begin_alloc_serial(begin);
    end.queryId = tracy->query++;
    end.context = tracy->id;
    ___tracy_emit_gpu_zone_end_serial(end);
    time.context = tracy->id;
    time.queryId = begin.queryId;
    time.gpuTime = (int64_t)timing->gpuBegin;
    ___tracy_emit_gpu_time_serial(time);
    time.queryId = end.queryId;
    time.gpuTime = (int64_t)timing->gpuEnd;
    ___tracy_emit_gpu_time_serial(time);
}

static inline void suppleTracyCollect(SuppleTracy* tracy, SuppleContext context) {
    uint32_t i, count = SUPPLE_TRACY_MOST_TIMINGS;
#ifdef TRACY_ON_DEMAND
    if (!___tracy_connected()) {
        return;
    }
#endif
    if (!tracy->hasBegun || suppleGetTimings(context, sizeof tracy->timings[0], tracy->timings, &count) < SUPPLE_OK ||
        count == 0 || tracy->timings[0].frame == tracy->frame) {
        return;
    }
    tracy->frame = tracy->timings[0].frame;
    count = count < SUPPLE_TRACY_MOST_TIMINGS ? count : SUPPLE_TRACY_MOST_TIMINGS;
    for (i = 0; i < count; ++i) {
        if (tracy->timings[i].pass != SUPPLE_PASS_SHORTFALL) { /* which is no pass */
            suppleTracyZone(tracy, &tracy->timings[i]);
        }
    }
}

#else

static inline void suppleTracyBegin(SuppleTracy* tracy, uint8_t id, const char* name, double deviceNow,
                                    double hostNow) {
    (void)tracy, (void)id, (void)name, (void)deviceNow, (void)hostNow;
}
static inline void suppleTracyCalibrate(SuppleTracy* tracy, double deviceNow, double hostNow) {
    (void)tracy, (void)deviceNow, (void)hostNow;
}
static inline void suppleTracyCollect(SuppleTracy* tracy, SuppleContext context) {
    (void)tracy, (void)context;
}

#endif

#ifdef __cplusplus
}
#endif
#endif
