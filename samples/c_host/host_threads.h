/* Threads and locks, which C99 has not: of Windows or of POSIX. */
#ifndef HOST_THREADS_H
#define HOST_THREADS_H

#ifdef _WIN32
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#include <windows.h>
typedef HANDLE HostThreadHandle;
typedef SRWLOCK HostMutex;
#define HOST_MUTEX_INITIALIZER SRWLOCK_INIT
#else
#include <pthread.h>
typedef pthread_t HostThreadHandle;
typedef pthread_mutex_t HostMutex;
#define HOST_MUTEX_INITIALIZER PTHREAD_MUTEX_INITIALIZER
#endif

typedef struct HostThread {
    HostThreadHandle handle;
    void (*run)(void* argument);
    void* argument;
} HostThread;

/* Calls run(argument) on a thread of its own; 0 if there is none. `thread` must stay where it is until it is joined. */
int hostStartThread(HostThread* thread, void (*run)(void* argument), void* argument);
void hostJoinThread(HostThread* thread);

void hostLock(HostMutex* mutex);
void hostUnlock(HostMutex* mutex);

#endif
