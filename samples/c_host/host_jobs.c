#define _POSIX_C_SOURCE 200809L

#include "host_jobs.h"

#include <pthread.h>
#include <stddef.h>

#define JOB_THREADS 3 /* beside the one that calls */

typedef struct Jobs {
    void (*job)(void* jobData, uint32_t i);
    void* jobData;
    uint32_t count, next;
    pthread_mutex_t mutex;
} Jobs;

static void* takeJobs(void* argument) {
    Jobs* jobs = argument;
    for (;;) {
        uint32_t i;
        pthread_mutex_lock(&jobs->mutex);
        i = jobs->next++;
        pthread_mutex_unlock(&jobs->mutex);
        if (i >= jobs->count) {
            return NULL;
        }
        jobs->job(jobs->jobData, i);
    }
}

void runHostJobs(uint32_t count, void (*job)(void* jobData, uint32_t i), void* jobData, void* user) {
    Jobs jobs = {0};
    pthread_t threads[JOB_THREADS];
    uint32_t started = 0;
    (void)user;
    jobs.job = job;
    jobs.jobData = jobData;
    jobs.count = count;
    pthread_mutex_init(&jobs.mutex, NULL);
    while (started < JOB_THREADS && started + 1 < count &&
           pthread_create(&threads[started], NULL, takeJobs, &jobs) == 0) {
        ++started;
    }
    takeJobs(&jobs);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
    pthread_mutex_destroy(&jobs.mutex);
}
