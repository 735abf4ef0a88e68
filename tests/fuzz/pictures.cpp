// Any PNG, JPEG, WebP or KTX2: decoded, or refused with a message.
#include "host/picture.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    const Result<host::Picture> picture = host::decodePicture(fuzz::bytesOf(data, size), "p");
    if (picture) {
        fuzz::demand(picture->rgba.size() == size_t{picture->width} * picture->height * 4,
                     "other pixels than its size");
    } else {
        fuzz::demand(picture.error().message.starts_with("p: "), "a refusal without the name");
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateBytes, data, size, most, seed);
}
