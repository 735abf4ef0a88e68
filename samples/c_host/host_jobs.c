#include "host_jobs.h"

#include "host_threads.h"

#define JOB_THREADS 3 /* beside the one that calls */

typedef struct Jobs {
    void (*job)(void* jobData, uint32_t i);
    void* jobData;
    uint32_t count, next;
    HostMutex mutex;
} Jobs;

static void takeJobs(void* argument) {
    Jobs* jobs = argument;
    for (;;) {
        uint32_t i;
        hostLock(&jobs->mutex);
        i = jobs->next++;
        hostUnlock(&jobs->mutex);
        if (i >= jobs->count) {
            return;
        }
        jobs->job(jobs->jobData, i);
    }
}

void runHostJobs(uint32_t count, void (*job)(void* jobData, uint32_t i), void* jobData, void* user) {
    Jobs jobs = {job, jobData, count, 0, HOST_MUTEX_INITIALIZER};
    HostThread threads[JOB_THREADS];
    uint32_t started = 0;
    (void)user;
    while (started < JOB_THREADS && started + 1 < count && hostStartThread(&threads[started], takeJobs, &jobs)) {
        ++started;
    }
    takeJobs(&jobs);
    while (started > 0) {
        hostJoinThread(&threads[--started]);
    }
}
