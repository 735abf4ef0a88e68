/* Jobs of Supple on threads. An engine would hand them to the threads that it has. */
#ifndef HOST_JOBS_H
#define HOST_JOBS_H

#include <stdint.h>

/* A SuppleRunJobsFunction. Works with as many threads as it can start; `user` is not used. */
void runHostJobs(uint32_t count, void (*job)(void* jobData, uint32_t i), void* jobData, void* user);

#endif
