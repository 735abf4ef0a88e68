#include "host_file.h"

#include <stdio.h>
#include <stdlib.h>

void* hostReadFile(const char* path, size_t* size) {
    FILE* file = path != NULL ? fopen(path, "rb") : NULL;
    void* bytes = NULL;
    long length = 0;
    *size = 0;
    if (file == NULL) {
        return NULL;
    }
    if (fseek(file, 0, SEEK_END) == 0 && (length = ftell(file)) > 0 && fseek(file, 0, SEEK_SET) == 0) {
        bytes = malloc((size_t)length);
        if (bytes != NULL && fread(bytes, 1, (size_t)length, file) == (size_t)length) {
            *size = (size_t)length;
        }
    }
    fclose(file);
    return bytes;
}
