#define _POSIX_C_SOURCE 200809L

#include "host_threads.h"

#include <stddef.h>

#ifdef _WIN32

static DWORD WINAPI enterThread(void* argument) {
    HostThread* thread = (HostThread*)argument;
    thread->run(thread->argument);
    return 0;
}

int hostStartThread(HostThread* thread, void (*run)(void* argument), void* argument) {
    thread->run = run;
    thread->argument = argument;
    thread->handle = CreateThread(NULL, 0, enterThread, thread, 0, NULL);
    return thread->handle != NULL;
}

void hostJoinThread(HostThread* thread) {
    WaitForSingleObject(thread->handle, INFINITE);
    CloseHandle(thread->handle);
}

void hostLock(HostMutex* mutex) {
    AcquireSRWLockExclusive(mutex);
}

void hostUnlock(HostMutex* mutex) {
    ReleaseSRWLockExclusive(mutex);
}

#else

static void* enterThread(void* argument) {
    HostThread* thread = (HostThread*)argument;
    thread->run(thread->argument);
    return NULL;
}

int hostStartThread(HostThread* thread, void (*run)(void* argument), void* argument) {
    thread->run = run;
    thread->argument = argument;
    return pthread_create(&thread->handle, NULL, enterThread, thread) == 0;
}

void hostJoinThread(HostThread* thread) {
    pthread_join(thread->handle, NULL);
}

void hostLock(HostMutex* mutex) {
    pthread_mutex_lock(mutex);
}

void hostUnlock(HostMutex* mutex) {
    pthread_mutex_unlock(mutex);
}

#endif
