/* supple_tracy.h as C99 -pedantic, with Tracy and without. */
#include <supple/supple_tracy.h>

void supple_tracy_c99(SuppleTracy* tracy, SuppleContext context) {
    suppleTracyBegin(tracy, 1, "Supple", 0.0, 0.0);
    suppleTracyCalibrate(tracy, 1.0, 1.0);
    suppleTracyCollect(tracy, context);
}
