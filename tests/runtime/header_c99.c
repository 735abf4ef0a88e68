/* The public header alone, as C99 -pedantic. */
#include <supple/supple.h>

const char* supple_header_c99(void) {
    return suppleResultString(SUPPLE_OK);
}
