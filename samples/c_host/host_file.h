#ifndef HOST_FILE_H
#define HOST_FILE_H

#include <stddef.h>

/* The bytes of a file, to be freed; null and size 0 where there is none, or no path. */
void* hostReadFile(const char* path, size_t* size);

#endif
