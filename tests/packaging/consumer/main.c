/* A host in C that needs no device: the library answers, and refuses what it must. */
#include <stdio.h>
#include <string.h>
#include <supple/supple.h>
#include <supple/supple_cpu.h>

int main(void) {
    SuppleContext context = NULL;
    if (strlen(suppleResultString(SUPPLE_OK)) == 0) {
        return 1;
    }
    if (suppleCreateContext(NULL, &context) != SUPPLE_ERROR_ARGUMENT || context != NULL) {
        return 2;
    }
    SuppleCpuGroup surfaces = NULL;
    if (suppleCpuCreateGroup(NULL, &surfaces) != SUPPLE_ERROR_ARGUMENT || surfaces != NULL) {
        return 3;
    }
    printf("C %d.%d.%d %s\n", SUPPLE_VERSION_MAJOR, SUPPLE_VERSION_MINOR, SUPPLE_VERSION_PATCH,
           suppleResultString(SUPPLE_ERROR_ARGUMENT));
    return 0;
}
